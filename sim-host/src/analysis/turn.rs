//! Steady turns about a straight glide: to first order in three ways, exactly, and as far as they go.
//!
//! Pitch and net mass are held at the glide's; the mass's rotation μ makes the turn (section 8 of the equations).

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use crate::analysis::{
    helix::{Helix, HelixSolver, Slope, Turn},
    trim::Glide,
};
use crate::model::vehicle::{MomentFrame, Vehicle};

/// Step of the walk along the branch of turns, rad.
const STEP_RAD: f64 = 0.02;
/// Beyond half a revolution the mass hangs on the other side.
const FARTHEST_RAD: f64 = std::f64::consts::PI;
const BISECTIONS: usize = 50;

/// Change of the motion per rad/s of turn rate, right positive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sensitivity {
    /// Of μ, s.
    pub mu_s: f64,
    /// Of φ, s.
    pub phi_s: f64,
    /// Of β, s.
    pub beta_s: f64,
}

/// The three ways to the first order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sensitivities {
    /// The 3×3 linear system; none where its assumptions do not hold: left–right symmetry, moments in the body frame.
    pub linear: Option<Sensitivity>,
    /// Equations (14)–(16) of the paper; none where its assumptions do not hold.
    pub closed_form: Option<Sensitivity>,
    /// Derivative of the exact helix.
    pub numeric: Option<Sensitivity>,
}

/// How fast it can turn one way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Authority {
    /// Largest turn rate on the branch that starts at the straight glide, rad/s, right positive.
    pub largest_turn_rate_rad_s: f64,
    /// Where it is reached, rad: beyond this μ the response reverses, or steady turns end.
    pub mu_rad: f64,
    /// Whether the response really reverses there.
    pub reverses: bool,
    /// The turn rate at the end of the mass's rotation, or the largest before it, rad/s.
    pub within_travel_rad_s: f64,
}

/// Authority both ways.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Authorities {
    /// Turning right.
    pub right: Authority,
    /// Turning left.
    pub left: Authority,
}

/// The ends of a walk to one side.
struct Farthest {
    /// Where the turn rate is largest.
    end: Helix,
    /// Whether the response reverses there.
    reverses: bool,
    /// The same within the mass's travel.
    within: Helix,
}

/// A branch of steady turns that starts at a straight glide.
#[derive(Clone, Debug)]
pub struct Turns<'a> {
    vehicle: &'a Vehicle,
    solver: HelixSolver,
    slope: Slope,
    straight: Helix,
}

impl<'a> Turns<'a> {
    /// The turns about a glide.
    ///
    /// # Errors
    /// One line if the full equations have no straight glide there (a vertical one, which no place of the mass balances).
    pub fn new(vehicle: &'a Vehicle, glide: &Glide) -> Result<Self, String> {
        let (solver, slope) = (HelixSolver::new(vehicle), Slope::Pitch(glide.pitch_rad));
        let straight = solver.solve(&Helix::from(glide), slope, Turn::Rate(0.0))?;
        Ok(Self { vehicle, solver, slope, straight })
    }

    /// First order, three ways.
    #[must_use]
    pub fn sensitivities(&self, glide: &Glide) -> Sensitivities {
        let at_rate = Turn::Rate(self.straight.turn_rate_rad_s);
        let numeric = self.solver.sensitivity(&self.straight, self.slope, at_rate);
        Sensitivities {
            linear: linear(self.vehicle, glide),
            closed_form: closed_form(self.vehicle, glide),
            numeric: numeric.map(|d| Sensitivity { mu_s: d.mu_rad, phi_s: d.roll_rad, beta_s: d.beta_rad }),
        }
    }

    /// The turn at a rate, rad/s, right positive.
    ///
    /// # Errors
    /// One line that names the largest reachable rate, and the helix that has it.
    pub fn at_rate(&self, turn_rate_rad_s: f64) -> Result<Helix, String> {
        if !turn_rate_rad_s.is_finite() {
            return Err(format!("turn rate {turn_rate_rad_s} rad/s: must be a finite number"));
        }
        let more = turn_rate_rad_s - self.straight.turn_rate_rad_s;
        let way = more.signum() * self.sense();
        let mut near = self.straight;
        for helix in self.walk(way) {
            if (helix.turn_rate_rad_s - turn_rate_rad_s) * more >= 0.0 {
                return self.solver.solve(&near, self.slope, Turn::Rate(turn_rate_rad_s));
            }
            near = helix;
        }
        let (end, _) = self.reversal(&near, way);
        if (end.turn_rate_rad_s - turn_rate_rad_s) * more >= 0.0 {
            // Between the walk's last step and the very end.
            return self.solver.solve(&near, self.slope, Turn::Rate(turn_rate_rad_s));
        }
        Err(format!(
            "turn rate {turn_rate_rad_s} rad/s: the largest that {} reaches at this pitch and net mass is {:.6} rad/s, at mu {:.2}°, \
             speed {:.4} m/s, roll {:.2}°",
            self.vehicle.name,
            end.turn_rate_rad_s,
            end.mu_rad.to_degrees(),
            end.speed_m_s,
            end.roll_rad.to_degrees()
        ))
    }

    /// How far turns go, both ways.
    #[must_use]
    pub fn authorities(&self) -> Authorities {
        let sense = self.sense();
        Authorities { right: self.authority(sense), left: self.authority(-sense) }
    }

    /// Sign of the μ that turns right.
    #[must_use]
    pub fn sense(&self) -> f64 {
        self.slope_of_rate(&self.straight).signum()
    }

    /// Turns at growing |μ| on one side, as long as the response keeps its sense and the search converges.
    fn walk(&self, way: f64) -> impl Iterator<Item = Helix> + '_ {
        let sense = self.sense();
        let mut helix = self.straight;
        std::iter::from_fn(move || {
            let mu_rad = helix.mu_rad + way * STEP_RAD;
            let next = self.solver.step(&helix, self.slope, Turn::Mu(mu_rad))?;
            let goes_on =
                (mu_rad - self.straight.mu_rad).abs() <= FARTHEST_RAD && self.slope_of_rate(&next) * sense > 0.0;
            helix = next;
            goes_on.then_some(next)
        })
    }

    /// The straight glide that the turns start at.
    pub(crate) fn straight(&self) -> &Helix {
        &self.straight
    }

    /// The fastest right turn within the mass's travel.
    #[must_use]
    pub fn fastest_right(&self) -> Helix {
        self.farthest(self.sense()).within
    }

    fn authority(&self, way: f64) -> Authority {
        let Farthest { end, reverses, within } = self.farthest(way);
        Authority {
            largest_turn_rate_rad_s: end.turn_rate_rad_s,
            mu_rad: end.mu_rad,
            reverses,
            within_travel_rad_s: within.turn_rate_rad_s,
        }
    }

    fn farthest(&self, way: f64) -> Farthest {
        let travel_rad = self.vehicle.moving_mass.roll_deg.map(f64::to_radians);
        let inside = |helix: &Helix| (travel_rad[0]..=travel_rad[1]).contains(&helix.mu_rad);
        let (mut last, mut within) = (self.straight, self.straight);
        for helix in self.walk(way) {
            if inside(&helix) {
                within = helix;
            }
            last = helix;
        }
        let (end, reverses) = self.reversal(&last, way);
        if inside(&end) {
            within = end;
        } else if let Some(stop) = self.solver.step(&within, self.slope, Turn::Mu(travel_rad[usize::from(way > 0.0)])) {
            within = stop;
        }
        Farthest { end, reverses, within }
    }

    /// Where the turn rate is largest, between the last step of a walk and one step beyond.
    fn reversal(&self, last: &Helix, way: f64) -> (Helix, bool) {
        let sense = self.sense();
        let (mut near, mut low, mut high) = (*last, 0.0, STEP_RAD);
        let mut reverses = false;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            match self.solver.step(&near, self.slope, Turn::Mu(last.mu_rad + way * middle)) {
                Some(helix) if self.slope_of_rate(&helix) * sense > 0.0 => {
                    near = helix;
                    low = middle;
                }
                beyond => {
                    reverses |= beyond.is_some();
                    high = middle;
                }
            }
        }
        (near, reverses)
    }

    /// dΩ/dμ, 1/s.
    fn slope_of_rate(&self, helix: &Helix) -> f64 {
        self.solver.sensitivity(helix, self.slope, Turn::Mu(helix.mu_rad)).map_or(0.0, |d| d.turn_rate_rad_s)
    }
}

/// Whether the vehicle is its own mirror image, with nothing but diagonal added mass and the couplings M_ẇ and N_v̇, its variable
/// volume at the centre of buoyancy and its flow attached.
fn is_plain(vehicle: &Vehicle, glide: &Glide) -> bool {
    let added = &vehicle.added_mass;
    let mut coupling = added.coupling_kg_m;
    coupling[(1, 2)] = 0.0;
    coupling[(2, 1)] = 0.0;
    let diagonal = Matrix3::from_diagonal(&added.mass_kg.diagonal());
    coupling == Matrix3::zeros()
        && added.mass_kg == diagonal
        && vehicle.body.centre_of_mass_m.y == 0.0
        && vehicle.hydrodynamics.moment_frame == MomentFrame::Body
        && vehicle.buoyancy.as_ref().is_none_or(|buoyancy| !buoyancy.acts_at_station)
        && vehicle.crossflow.as_ref().is_none_or(|crossflow| glide.alpha_rad.abs() <= crossflow.stall_deg.to_radians())
}

/// The 3×3 system A (β, φ, μ)ᵀ + b Ω = 0 of section 8.
fn linear(vehicle: &Vehicle, glide: &Glide) -> Option<Sensitivity> {
    if !is_plain(vehicle, glide) {
        return None;
    }
    let (h, water, mass, body) = (&vehicle.hydrodynamics, &vehicle.water, &vehicle.moving_mass, &vehicle.body);
    let (speed, g, m_net) = (glide.speed_m_s, water.gravity_m_s2, glide.net_mass_kg);
    let (s, c) = libm::sincos(glide.pitch_rad);
    let (u, w) = (speed * libm::cos(glide.alpha_rad), speed * libm::sin(glide.alpha_rad));
    let [m1, m2, m3] = [0, 1, 2].map(|i| vehicle.mass_kg() + vehicle.added_mass.mass_kg[(i, i)]);
    let (c12, c21) = (vehicle.added_mass.coupling_kg_m[(1, 2)], vehicle.added_mass.coupling_kg_m[(2, 1)]);
    let gx = body.mass_kg * body.centre_of_mass_m.x + mass.mass_kg * glide.r_px_m;
    let gz = body.mass_kg * body.centre_of_mass_m.z + mass.mass_kg * mass.radius_m;
    let lever = mass.mass_kg * mass.radius_m;
    let pressure = 0.5 * water.density_kg_m3 * speed * speed * h.area_m2;
    // p̂ and r̂ per unit of Ω.
    let per_rate = h.span_m / (2.0 * vehicle.nominal_speed_m_s);
    let (p, r) = (-s * per_rate, c * per_rate);
    let (h_y, p_n) = (gz * u - gx * w + c12 * w, (gx + c21) * c + gz * s);

    let qb = pressure * h.span_m;
    let matrix = Matrix3::new(
        pressure * (h.c_y_beta - glide.drag_coefficient),
        m_net * g * c,
        0.0,
        (m2 - m3) * w * speed + qb * h.c_roll_beta,
        -g * c * gz,
        -g * c * lever,
        (m1 - m2) * u * speed + qb * h.c_n_beta,
        g * c * gx,
        -g * s * lever,
    );
    let vector = Vector3::new(
        -m3 * w * s - m1 * u * c + pressure * (h.c_y_p * p + h.c_y_r * r),
        h_y * c + w * p_n + qb * (h.c_roll_p * p + h.c_roll_r * r),
        h_y * s - u * p_n + qb * (h.c_n_p * p + h.c_n_r * r),
    );
    let x = matrix.lu().solve(&-vector)?;
    Some(Sensitivity { mu_s: x.z, phi_s: x.y, beta_s: x.x })
}

/// Equations (14)–(16) where nothing that they leave out is there.
fn closed_form(vehicle: &Vehicle, glide: &Glide) -> Option<Sensitivity> {
    let h = &vehicle.hydrodynamics;
    let dropped = [h.c_l_zero, h.c_y_p, h.c_y_r, h.c_roll_r, h.c_n_p, vehicle.body.centre_of_mass_m.x];
    (is_plain(vehicle, glide) && dropped.iter().all(|value| *value == 0.0)).then(|| equations_14_to_16(vehicle, glide))
}

/// Equations (14)–(16), with the displaced mass for m in (14) and (16) and the coefficients brought to the paper's normalisation.
///
/// They leave out C_L0, C_Yp, C_Yr, C_lr, C_np and the body's own offset along its axis, whatever the vehicle has.
#[must_use]
pub fn equations_14_to_16(vehicle: &Vehicle, glide: &Glide) -> Sensitivity {
    let (h, body, mass) = (&vehicle.hydrodynamics, &vehicle.body, &vehicle.moving_mass);
    let (rho, g, speed) = (vehicle.water.density_kg_m3, vehicle.water.gravity_m_s2, glide.speed_m_s);
    let (m_net, m_d) = (glide.net_mass_kg, vehicle.mass_kg() - glide.net_mass_kg);
    let [x_u, y_v, z_w] = [0, 1, 2].map(|i| -vehicle.added_mass.mass_kg[(i, i)]);
    let (m_w, n_v) = (-vehicle.added_mass.coupling_kg_m[(1, 2)], -vehicle.added_mass.coupling_kg_m[(2, 1)]);
    let gx = mass.mass_kg * glide.r_px_m;
    let gz = body.mass_kg * body.centre_of_mass_m.z + mass.mass_kg * mass.radius_m;
    let (sa, ca) = libm::sincos(glide.alpha_rad);
    let (s, c) = libm::sincos(glide.pitch_rad);
    let s_rho = h.area_m2 * rho;
    let rate_scale = 0.5 * h.span_m * h.span_m * speed / vehicle.nominal_speed_m_s;
    let (l2_c_nr, l2_c_lp) = (rate_scale * h.c_n_r, rate_scale * h.c_roll_p);
    let c_ds = glide.drag_coefficient - h.c_y_beta;

    let yaw_rate = l2_c_nr * m_net * s_rho + 2.0 * (m_net * n_v + gx * (m_d - x_u)) * ca;
    let n = yaw_rate * c * c
        + (l2_c_lp * m_net * s_rho + 2.0 * gz * (m_d - z_w) * sa) * s * s
        + (gz * (m_d - x_u) * ca + (m_net * n_v + gx * (m_d - z_w)) * sa) * 2.0 * s * c;
    let y_beta = s_rho * (h.c_n_beta * h.span_m * m_net + gx * c_ds) + 2.0 * m_net * (y_v - x_u) * ca;
    let r_beta = s_rho * (gz * c_ds - h.c_roll_beta * h.span_m * m_net) + 2.0 * m_net * (y_v - z_w) * sa;
    let d = y_beta * c + r_beta * s;
    let phi_s = speed / (2.0 * g * m_net * c)
        * (2.0 * (m_d + m_net - x_u) * ca * c + 2.0 * (m_d + m_net - z_w) * sa * s - s_rho * c_ds * n / d);
    let mu_s = speed / (2.0 * g * mass.mass_kg * m_net * mass.radius_m)
        * (yaw_rate * c / s + 2.0 * (gx * (m_d - z_w) - m_net * m_w) * sa - y_beta / s * n / d);
    Sensitivity { mu_s, phi_s, beta_s: -n / (speed * d) }
}
