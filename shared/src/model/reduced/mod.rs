//! The reduced model: motion through the water, driven by what is measured.
//!
//! Rows 1 and 3 of the momentum balance (4) of Fan & Woolsey (2013), with attitude and pitch rate taken from the
//! instruments, net mass from the buoyancy device and the water's density from whoever knows it; side velocity is left out.
//! Its steady state is the glide polar; through an inflection it keeps the speed that the quasi-steady balance forgets.
//! [`turn`] adds the turn rate.
//!
//! It computes in any [`Number`]: `f32`, or [`crate::model::number::Fixed`] without an FPU. All its quantities are of the order of 1
//! whatever the vehicle's size, since forces are divided by its mass; state and drive are held to [`limits`], and between
//! those no intermediate result overflows a `Fixed` (a test runs this same code over intervals).

#![allow(clippy::arithmetic_side_effects, reason = "the operators of a Number saturate by its contract")]

pub mod turn;

use crate::model::{number::Number, vehicle::GlideConstants};

/// What drives the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<N> {
    /// Pitch, rad.
    pub pitch_rad: N,
    /// Roll, rad.
    pub roll_rad: N,
    /// Rate about the body's right axis, rad/s.
    pub pitch_rate_rad_s: N,
    /// Axial position of the moving mass, m.
    pub r_px_m: N,
    /// Net mass in this water, kg, positive sinks.
    pub net_mass_kg: N,
    /// Density of this water over the vehicle file's.
    pub density_ratio: N,
}

/// Bounds to which state and drive are held: beyond them the inputs were wrong, and a bounded answer is better than none.
pub mod limits {
    /// No glider is faster along an axis, m/s.
    pub const SPEED_M_S: f32 = 3.0;
    /// Pitch and roll, rad.
    pub const ANGLE_RAD: f32 = 3.2;
    /// Pitch rate, rad/s.
    pub const RATE_RAD_S: f32 = 1.0;
    /// Axial position, m.
    pub const R_PX_M: f32 = 2.0;
    /// Net mass, kg.
    pub const NET_MASS_KG: f32 = 5.0;
    /// Density of water, from nearly boiling to the Dead Sea, over the file's.
    pub const DENSITY_RATIO: [f32; 2] = [0.9, 1.3];
}

/// Velocity through the water in the body's plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<N> {
    /// Forward, m/s.
    pub u_m_s: N,
    /// Down through the belly, m/s.
    pub w_m_s: N,
    /// What drove it last, and how fast the moving mass went, m/s.
    last: Option<(Drive<N>, N)>,
}

/// The constants of one vehicle, per unit of its mass along b1, and the time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<N> {
    /// g/m₁, m/s² per kg of net mass.
    gravity: N,
    /// Drag at zero lift, 1/m.
    drag_zero: N,
    /// Induced drag per lift squared, m.
    drag_induced: N,
    /// Lift at zero angle of attack, 1/m.
    lift_zero: N,
    /// Lift slope, 1/m per rad.
    lift_alpha: N,
    /// Lift by pitch rate, 1/m per rad/s.
    lift_rate: N,
    /// m₁/m₃ and m₃/m₁.
    surge_over_heave: N,
    heave_over_surge: N,
    /// Forward momentum per pitch rate, over m₁, m.
    surge_arm_m: N,
    /// Share of the moving mass in m₁.
    surge_per_r_px_rate: N,
    /// Upward momentum per pitch rate, over m₃, m: what does not depend on the moving mass, and what does, per m of it.
    heave_arm_m: N,
    heave_arm_per_r_px: N,
    dt_s: N,
    rate_hz: N,
}

impl<N: Number> Drive<N> {
    /// The nearest drive within [`limits`].
    fn held(&self) -> Self {
        let within = |x: N, size: f32| x.clamp(N::new(-size), N::new(size));
        let [thin, dense] = limits::DENSITY_RATIO;
        Self {
            pitch_rad: within(self.pitch_rad, limits::ANGLE_RAD),
            roll_rad: within(self.roll_rad, limits::ANGLE_RAD),
            pitch_rate_rad_s: within(self.pitch_rate_rad_s, limits::RATE_RAD_S),
            r_px_m: within(self.r_px_m, limits::R_PX_M),
            net_mass_kg: within(self.net_mass_kg, limits::NET_MASS_KG),
            density_ratio: self.density_ratio.clamp(N::new(thin), N::new(dense)),
        }
    }

    /// Halfway between two drives.
    fn halfway(&self, other: &Self) -> Self {
        let mean = |a: N, b: N| N::new(0.5) * (a + b);
        Self {
            pitch_rad: mean(self.pitch_rad, other.pitch_rad),
            roll_rad: mean(self.roll_rad, other.roll_rad),
            pitch_rate_rad_s: mean(self.pitch_rate_rad_s, other.pitch_rate_rad_s),
            r_px_m: mean(self.r_px_m, other.r_px_m),
            net_mass_kg: mean(self.net_mass_kg, other.net_mass_kg),
            density_ratio: mean(self.density_ratio, other.density_ratio),
        }
    }
}

impl<N: Number> Motion<N> {
    /// At rest in the water.
    #[must_use]
    pub fn at_rest() -> Self {
        Self::new(N::new(0.0), N::new(0.0))
    }

    /// At a known velocity.
    #[must_use]
    pub const fn new(u_m_s: N, w_m_s: N) -> Self {
        Self { u_m_s, w_m_s, last: None }
    }

    /// Speed through the water, m/s.
    #[must_use]
    pub fn speed_m_s(&self) -> N {
        self.u_m_s.hypot(self.w_m_s)
    }

    /// Angle of attack, rad.
    #[must_use]
    pub fn alpha_rad(&self) -> N {
        self.w_m_s.atan2(self.u_m_s)
    }

    /// Vertical speed through the water at an attitude in rad, m/s, down positive.
    #[must_use]
    pub fn sink_rate_m_s(&self, pitch_rad: N, roll_rad: N) -> N {
        let (sin_pitch, cos_pitch) = pitch_rad.sin_cos();
        self.w_m_s * roll_rad.cos() * cos_pitch - self.u_m_s * sin_pitch
    }
}

impl<N: Number> Model<N> {
    /// The model of a vehicle, in steps of `dt_s`.
    #[must_use]
    pub fn new(vehicle: &GlideConstants, gravity_m_s2: f32, dt_s: f32) -> Self {
        let (m1, m3) = (vehicle.mass_u_kg, vehicle.mass_w_kg);
        Self {
            gravity: N::new(gravity_m_s2 / m1),
            drag_zero: N::new(vehicle.drag_zero / m1),
            drag_induced: N::new(vehicle.drag_induced * m1),
            lift_zero: N::new(vehicle.lift_zero / m1),
            lift_alpha: N::new(vehicle.lift_alpha / m1),
            lift_rate: N::new(vehicle.lift_rate / m1),
            surge_over_heave: N::new(m1 / m3),
            heave_over_surge: N::new(m3 / m1),
            surge_arm_m: N::new(vehicle.surge_coupling_kg_m / m1),
            heave_arm_m: N::new(vehicle.heave_coupling_kg_m / m3),
            heave_arm_per_r_px: N::new(vehicle.moving_mass_kg / m3),
            surge_per_r_px_rate: N::new(vehicle.moving_mass_kg / m1),
            dt_s: N::new(dt_s),
            rate_hz: N::new(1.0 / dt_s),
        }
    }

    /// The motion one time step later, when `drive` is measured (midpoint rule). Stays bounded whatever the drive.
    #[must_use]
    pub fn step(&self, motion: &Motion<N>, drive: &Drive<N>) -> Motion<N> {
        let now = drive.held();
        let (before, before_rate) = motion.last.unwrap_or((now, N::new(0.0)));
        let between = now.halfway(&before);
        let r_px_rate = (now.r_px_m - before.r_px_m) * self.rate_hz;
        // Momenta over mass are what the balance is about: they change smoothly even where a rate jumps.
        let (surge, heave) = self.momenta(motion, &before, before_rate);
        let weight = self.weight(&between);
        let (surge_rate, heave_rate) = self.rates(surge, heave, motion, &between, weight);
        let half = N::new(0.5) * self.dt_s;
        let (middle_surge, middle_heave) = (surge + half * surge_rate, heave + half * heave_rate);
        let middle = self.motion(middle_surge, middle_heave, &between, r_px_rate);
        let (surge_rate, heave_rate) = self.rates(middle_surge, middle_heave, &middle, &between, weight);
        self.motion(surge + self.dt_s * surge_rate, heave + self.dt_s * heave_rate, &now, r_px_rate)
    }

    /// Momenta along b1 and b3 over m₁ and m₃, m/s: beside the velocity of the centre of buoyancy, what the pitch rate gives
    /// to masses away from it, and the moving mass's own.
    fn momenta(&self, motion: &Motion<N>, drive: &Drive<N>, r_px_rate: N) -> (N, N) {
        let q = drive.pitch_rate_rad_s;
        let surge = motion.u_m_s + self.surge_arm_m * q + self.surge_per_r_px_rate * r_px_rate;
        (surge, motion.w_m_s - self.heave_arm(drive) * q)
    }

    /// The motion that has these momenta.
    fn motion(&self, surge: N, heave: N, drive: &Drive<N>, r_px_rate: N) -> Motion<N> {
        let q = drive.pitch_rate_rad_s;
        let bounded = |x: N| x.clamp(N::new(-limits::SPEED_M_S), N::new(limits::SPEED_M_S));
        Motion {
            u_m_s: bounded(surge - self.surge_arm_m * q - self.surge_per_r_px_rate * r_px_rate),
            w_m_s: bounded(heave + self.heave_arm(drive) * q),
            last: Some((*drive, r_px_rate)),
        }
    }

    fn heave_arm(&self, drive: &Drive<N>) -> N {
        self.heave_arm_m + self.heave_arm_per_r_px * drive.r_px_m
    }

    /// Net weight over m₁ along b1 and b3, m/s².
    fn weight(&self, drive: &Drive<N>) -> (N, N) {
        let (sin_pitch, cos_pitch) = drive.pitch_rad.sin_cos();
        let weight = self.gravity * drive.net_mass_kg;
        (-(weight * sin_pitch), weight * cos_pitch * drive.roll_rad.cos())
    }

    /// Rates of the momenta over mass, m/s².
    fn rates(&self, surge: N, heave: N, motion: &Motion<N>, drive: &Drive<N>, (weight_x, weight_z): (N, N)) -> (N, N) {
        let (u, w) = (motion.u_m_s, motion.w_m_s);
        let q = drive.pitch_rate_rad_s;
        let lift_factor = self.lift_zero + self.lift_alpha * motion.alpha_rad() + self.lift_rate * q;
        // Both per unit speed, so that no division by the speed is left.
        let dynamic = drive.density_ratio * motion.speed_m_s();
        let lift = lift_factor * dynamic;
        let drag = (self.drag_zero + self.drag_induced * lift_factor * lift_factor) * dynamic;
        let x = lift * w - drag * u + weight_x;
        let z = -(lift * u) - drag * w + weight_z;
        (x - self.heave_over_surge * heave * q, self.surge_over_heave * z + self.surge_over_heave * surge * q)
    }
}

#[cfg(test)]
pub(crate) mod tests;
