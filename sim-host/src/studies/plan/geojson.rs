//! A plan for maps: GeoJSON (RFC 7946), longitude before latitude.

use serde_json::{Value, json};

use super::Plan;
use crate::flight::{NorthEast, mission_file::Start};

/// Nominal track, members' surfacings, and where it is expected to come up with its ellipses.
#[must_use]
pub fn geojson(plan: &Plan) -> Value {
    let at = |place: &NorthEast| position(place, &plan.start);
    let track: Vec<_> = plan.track.iter().map(|point| at(&point.place)).collect();
    let members: Vec<_> = plan.members.iter().filter_map(|member| member.surfacing.as_ref()).map(at).collect();
    let mut features = vec![
        feature("nominal track", "LineString", &json!(track)),
        feature("surfacings of the members", "MultiPoint", &json!(members)),
    ];
    if let Some(surfacing) = &plan.surfacing {
        features.push(feature("expected surfacing", "Point", &json!(at(&surfacing.mean))));
        for holding in &surfacing.ellipses {
            let outline: Vec<_> = holding.ellipse.outline().map(|place| at(&place)).collect();
            let name = format!("{:.0} % of surfacings", 100.0 * holding.ellipse.share);
            features.push(feature(&name, "Polygon", &json!([outline])));
        }
    }
    json!({ "type": "FeatureCollection", "features": features })
}

fn position(place: &NorthEast, start: &Start) -> [f64; 2] {
    let [latitude_deg, longitude_deg] = place.latitude_longitude_deg(start);
    [longitude_deg, latitude_deg]
}

fn feature(name: &str, kind: &str, coordinates: &Value) -> Value {
    json!({
        "type": "Feature",
        "properties": { "name": name },
        "geometry": { "type": kind, "coordinates": coordinates },
    })
}
