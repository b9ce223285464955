//! Lines of equal value.

use contour::ContourBuilder;

/// Lines on which a quantity has a level, from its values on a grid: `value(i, j)` at `x[i]`, `y[j]`, both evenly spaced.
///
/// None on a grid of less than three values each way.
#[must_use]
pub fn contours(x: &[f64], y: &[f64], value: impl Fn(usize, usize) -> f64, level: f64) -> Vec<Vec<[f64; 2]>> {
    let ([x0, x1, .., xn], [y0, y1, .., yn]) = (x, y) else { return Vec::new() };
    let values: Vec<f64> =
        (0..y.len()).flat_map(|j| (0..x.len()).map(move |i| (i, j))).map(|(i, j)| value(i, j)).collect();
    // The library puts the value of a cell into its middle.
    let [dx, dy] = [x1 - x0, y1 - y0];
    let builder = ContourBuilder::new(x.len(), y.len(), true);
    let builder = builder.x_step(dx).y_step(dy).x_origin(x0 - 0.5 * dx).y_origin(y0 - 0.5 * dy);
    let Ok(lines) = builder.lines(&values, &[level]) else { return Vec::new() };
    // It also closes the lines around the grid, half a cell outside.
    let inside = |place: &[f64; 2]| (*x0..=*xn).contains(&place[0]) && (*y0..=*yn).contains(&place[1]);
    lines
        .iter()
        .flat_map(|line| line.geometry().0.iter())
        .map(|line| line.coords().map(|place| [place.x, place.y]).collect::<Vec<_>>())
        .flat_map(|line| line.split(|place| !inside(place)).map(<[_]>::to_vec).collect::<Vec<_>>())
        .filter(|line| line.len() > 1)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_of_a_plane_is_a_straight_line() {
        let [x, y] = [[0.0, 1.0, 2.0, 3.0], [10.0, 20.0, 30.0, 40.0]];
        let lines = contours(&x, &y, |i, j| x[i] + y[j] / 10.0, 3.5);
        assert!(!lines.is_empty());
        for [x, y] in lines.into_iter().flatten() {
            assert!((x + y / 10.0 - 3.5).abs() < 1e-9, "({x}, {y})");
        }
    }
}
