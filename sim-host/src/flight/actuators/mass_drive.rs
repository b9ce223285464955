//! The moving mass under its motors: u_px and u_μ of equations (6) and (7), eight degrees of freedom while anything moves.
//!
//! Each sub-step finds the force and moment that bring the mass to where screw, brake, friction and stops let it be: the equations
//! are linear in u, so their response to a unit of each is exact. No contact is a stiff spring, so none limits the step.

use nalgebra::{Matrix2, Vector2};

use super::axis::{Axis, Motor};
use crate::flight::TICK_S;
use crate::model::{
    ocean::{Ocean, OceanFrom},
    plant::{Input, Medium, Particle, Plant, State, rk4_step},
    vehicle::{Drive, MovingMass},
};

/// Sub-steps of a tick in which something moves: the mass overruns a stop by half a sub-step's way at most, 0.08 mm at 1 cm/s.
const SUB_STEPS: u32 = 16;
/// Duration of a sub-step, s.
const SUB_STEP_S: f64 = TICK_S / SUB_STEPS as f64;

/// Motors and brakes of the moving mass.
#[derive(Clone, Debug)]
pub(super) struct MassDrive {
    axes: [Axis; 2],
    /// From the first tick on: clamped where the mass then is.
    motors: Option<[Motor; 2]>,
}

/// The state after a tick, and what its motors took.
pub(super) struct Moved {
    pub(super) state: State<f64>,
    /// Axial drive and rotation drive, J.
    pub(super) energy_j: [f64; 2],
}

impl MassDrive {
    /// The motors of a vehicle that has some.
    pub(super) fn new(mass: &MovingMass) -> Option<Self> {
        match &mass.drive {
            Drive::Kinematic => None,
            Drive::Dynamic { axial, rotation } => {
                Some(Self { axes: [Axis::axial(mass, axial), Axis::rotation(mass, rotation)], motors: None })
            }
        }
    }

    /// One tick at commanded speeds (m/s and rad/s) and a rate of displaced volume, in an ocean from a time on; nothing if the
    /// brakes hold all through it.
    pub(super) fn advance(
        &mut self,
        plant: &Plant<f64>,
        state: &State<f64>,
        commands: [f64; 2],
        u_b_m3_s: f64,
        (ocean, time_s): (&Ocean, f64),
    ) -> Option<Moved> {
        let motors = self.motors.get_or_insert([state.r_px_m, state.mu_rad].map(Motor::braked));
        let braked = commands == [0.0; 2] && motors.iter().all(|motor| motor.clamped_at.is_some());
        if braked && at_rest(state) && holds(&self.axes, plant, state, &ocean.from_time(time_s)) {
            return None;
        }
        let mut moved = Moved { state: *state, energy_j: [0.0; 2] };
        for step in 0..SUB_STEPS {
            let water = ocean.from_time(time_s + f64::from(step) * SUB_STEP_S);
            for ((motor, axis), (command, place)) in
                motors.iter_mut().zip(&self.axes).zip(commands.into_iter().zip(place(&moved.state)))
            {
                motor.follow(axis, command, place, SUB_STEP_S);
            }
            sub_step(&self.axes, motors, plant, &mut moved, (u_b_m3_s, &water));
        }
        settle(motors, plant, &mut moved.state);
        Some(moved)
    }
}

/// Whether brakes of these ratings bear the load of a particle at rest.
fn holds(axes: &[Axis; 2], plant: &Plant<f64>, state: &State<f64>, water: &OceanFrom<'_>) -> bool {
    let load = plant.reaction(state, &water.around(&state.position_m, 0.0));
    load.u_px_n.abs() <= axes[0].brake && load.u_mu_nm.abs() <= axes[1].brake
}

/// One sub-step: the forces that make the wanted rates, then the equations with the particle free.
fn sub_step(
    axes: &[Axis; 2],
    motors: &mut [Motor; 2],
    plant: &Plant<f64>,
    moved: &mut Moved,
    (u_b_m3_s, water): (f64, &OceanFrom<'_>),
) {
    let state = moved.state;
    let around = water.around(&state.position_m, 0.0);
    let rates = |u: [f64; 2]| {
        let rate = plant.derivative(&state, &Input { u_px_n: u[0], u_mu_nm: u[1], u_b_m3_s }, &around);
        Vector2::new(rate.r_px_rate_m_s, rate.mu_rate_rad_s)
    };
    let free = rates([0.0; 2]);
    let response = Matrix2::from_columns(&[rates([1.0, 0.0]) - free, rates([0.0, 1.0]) - free]);
    let (places, now) = (place(&state), speed(&state));
    let wanted = Vector2::from_fn(|i, _| {
        let slowing = axes[i].friction * response[(i, i)] * SUB_STEP_S;
        motors[i].next_rate(&axes[i], places[i], now[i] + free[i] * SUB_STEP_S, slowing, SUB_STEP_S)
    });
    // The response is a block of the inverse of a positive definite matrix, so it has an inverse.
    let needed = (wanted - Vector2::from(now)) / SUB_STEP_S - free;
    let mut u = response.try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * needed);
    for (i, motor) in motors.iter_mut().enumerate() {
        u[i] = motor.brake(&axes[i], u[i], places[i]);
        moved.energy_j[i] += motor.work(&axes[i], u[i], places[i], wanted[i], SUB_STEP_S);
    }
    let input = Input { u_px_n: u[0], u_mu_nm: u[1], u_b_m3_s };
    moved.state = rk4_step(plant, &state, &Particle::Free(input), SUB_STEP_S, water);
}

/// Once both brakes hold a mass that no longer moves to speak of, it stands exactly where they closed.
fn settle(motors: &[Motor; 2], plant: &Plant<f64>, state: &mut State<f64>) {
    // Rounding and the sub-step's error leave some nm/s; a mass that slips is faster within one sub-step.
    const STILL: f64 = 1e-6;
    let [Some(r_px_m), Some(mu_rad)] = motors.map(|motor| motor.clamped_at) else { return };
    if speed(state).iter().all(|rate| rate.abs() < STILL) {
        *state = State { r_px_m, mu_rad, ..plant.with_particle_rates(state, 0.0, 0.0) };
    }
}

fn at_rest(state: &State<f64>) -> bool {
    speed(state) == [0.0; 2]
}

fn place(state: &State<f64>) -> [f64; 2] {
    [state.r_px_m, state.mu_rad]
}

fn speed(state: &State<f64>) -> [f64; 2] {
    [state.r_px_rate_m_s, state.mu_rate_rad_s]
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::model::{
        plant::quaternion_from_euler,
        vehicle::{AxialDrive, RotationDrive, Vehicle},
    };

    /// Whether brakes of these ratings keep the mass of this state where it is.
    fn stays(state: &State<f64>, brake_n: f64, brake_nm: f64) -> bool {
        let mut vehicle = Vehicle::load("slocum-paper").unwrap();
        vehicle.moving_mass.drive = Drive::Dynamic {
            axial: AxialDrive { brake_n, ..AxialDrive::default() },
            rotation: RotationDrive { brake_nm, ..RotationDrive::default() },
        };
        let plant = Plant::<f64>::new(&vehicle);
        let mut drive = MassDrive::new(&vehicle.moving_mass).unwrap();
        drive
            .advance(&plant, state, [0.0; 2], 0.0, (&Ocean::still(&vehicle.water), 0.0))
            .is_none_or(|moved| place(&moved.state) == place(state))
    }

    #[test]
    fn a_brake_holds_any_load_up_to_its_rating_and_none_beyond() {
        let vehicle = Vehicle::load("slocum-paper").unwrap();
        let (plant, ocean) = (Plant::<f64>::new(&vehicle), Ocean::still(&vehicle.water));
        for (roll, pitch, mu, turn) in
            [(0.0, 1.5, 0.0, 0.0), (3.0, -0.4, 0.9, 0.5), (-1.4, 0.2, -1.0, -2.0), (0.3, -1.0, 0.5, 1.0)]
        {
            let state = State {
                quaternion: quaternion_from_euler(&Vector3::new(roll, pitch, 0.0)),
                velocity_m_s: Vector3::new(0.5, 0.1, -0.2),
                rate_rad_s: Vector3::new(0.3, -0.2, turn),
                r_px_m: 0.1,
                mu_rad: mu,
                ..State::at_rest(plant.displaced_volume_m3(0.2))
            };
            let load = plant.reaction(&state, &ocean.from_time(0.0).around(&state.position_m, 0.0));
            let (force, moment) = (load.u_px_n.abs(), load.u_mu_nm.abs());
            // What is needed changes within a tick; the rating is compared at its beginning.
            assert!(stays(&state, 1.001 * force, 1.001 * moment), "{force} N, {moment} N m");
            assert!(!stays(&state, 0.8 * force, 1.001 * moment), "{force} N");
            assert!(moment < 0.1 || !stays(&state, 1.001 * force, 0.8 * moment), "{moment} N m");
        }
    }
}
