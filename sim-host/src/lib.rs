//! The plant of an underwater glider, and everything that flies it on a host.
//!
//! # How the plant is verified
//!
//! Each row is a test; "lopsided" is a vehicle with every symmetry of slocum-paper broken (`tests/common`).
//!
//! | what must hold | where | tolerance, and what sets it |
//! |---|---|---|
//! | two states as an independent model gives them | `tests/plant.rs` | 1e-11 relative: rounding |
//! | Lagrange's equations in Euler angles, 200 random states, lopsided too | `tests/lagrange.rs` | 1e-12 relative: rounding |
//! | kinetic energy, tumbling 10 s, particle free | `tests/plant.rs` | 1e-9 relative: fourth order at 0.5 ms |
//! | linear and angular impulse (Kirchhoff's) without forces | `tests/conservation.rs` | 1e-9 relative over 5 s |
//! | impulse under gravity: grows by the net weight | `tests/conservation.rs` | 1e-8 relative over 2 s |
//! | dE/dt = viscous + actuator + buoyancy work, exact derivative | `tests/conservation.rs` | 1e-11 W: terms of 100 W cancel |
//! | left and right alike | `tests/conservation.rs` | 1e-12 of the largest acceleration |
//! | rest, reversed and lateral flow, tenfold added mass: finite, energy balances | `tests/conservation.rs` | 1e-6 relative: Simpson's rule |
//! | six and eight degrees of freedom agree under the drive's reaction | `tests/plant.rs` | 1e-11: rounding of an 8×8 solve |
//! | a drive that starts keeps the momentum | `tests/plant.rs` | 1e-12: rounding |
//! | a dive under motors, eight degrees of freedom, as with the kinematic drive | `tests/mass_drive.rs` | 5e-4 of the way: lag of a sub-step |
//! | end stops and brakes hold, moves cost what fielded ones cost | `tests/mass_drive.rs` | half a sub-step's way; 2 to 5 and 2 to 6 J |
//! | fourth order on a whole dive and climb | `tests/integration.rs` | observed order 3.7 to 4.5; 0.8 mm at the flight's step |
//! | an adaptive eighth-order integrator of a library | `tests/integration.rs` | 1e-8 |
//! | a uniform current shifts the track and nothing else | `tests/moving_water.rs` | the same bits; 1e-9 m of track |
//! | what weighs like water is carried like water: accelerating current, swell, shear | `tests/moving_water.rs` | 1e-13 m/s: rounding |
//! | energy in a steady irrotational flow, lopsided | `tests/moving_water.rs` | 1e-7 relative: fourth order at 5 ms |
//! | TEOS-10's published check values | `ocean::teos10` | 1e-9 kg/m³; 2e-5 °C of Θ: a fit's |
//! | cross flow: attached law below the stall, drag of the plan view across, never gives energy | `tests/crossflow.rs` | equal bits; 1e-12; sign |
//! | the paper's trim, Tables 1 and 2, eqs (14)–(16) = 3×3 system = exact helix | `tests/trim.rs`, `tests/stability.rs` | printed digits; 1e-9 |
//! | every printed number and stated trend beside ours, every figure drawn | `tests/paper.rs` | printed digits; 0.005 and 0.5° for eigenvectors |
//! | straight glides, turns and modes of 50 random lopsided vehicles, or one clear refusal | `tests/asymmetric.rs` | 1e-8 N |
//! | trim tables against exact trim, middles of all cells and random points | `tests/table.rs` | 0.5 % of speed, 0.2° of pitch, 2 % of turn rate |
//! | the reduced model, f32 and fixed point, against the plant | `tests/reduced.rs` | 1e-4 m/s and 0.01 m through an inflection |
//! | a swung compass: made-up fields found again, heading held in flight by the table | `tests/swing.rs` | readings of 0.01°; the heading loop's deadband |
//! | electrical energy of the pump over p ΔV | `tests/devices.rs` | fielded efficiencies; 1e-9 for p ΔV itself |
//! | every abort: its fault is noticed in time, and the vehicle comes back | `tests/aborts.rs` | when the fault can be seen |
//! | a record replays to the same commands; a changed, cut or foreign one is told with its place | `tests/replay.rs` | the same bits |
//! | a dive turns above a sloping floor by the altimeter | `tests/ocean.rs` | 3 m of the height asked for |
//! | pressure in the hull by the gas law, echoes by beam and range | `flight::sensors` | 1e-12 relative; whole steps |
//! | linearisation by dual numbers against central differences | `tests/stability.rs` | 1e-7 relative: the differences' own error |
//! | closed loops around the linearised plant against the full plant flown by the same laws | `tests/margins.rs` | grows or dies out |
//! | sampled integrators: margins in closed form | `margins::sampled` | 1e-6: bisection |
//! | an ellipse of surfacings holds its share of other seeds' | `tests/plan.rs` | three deviations of the counts |
//! | waypoints across a current, one out of reach, a mooring, a drift | `tests/guidance.rs` | the capture radius; the mooring's |
//! | surfacings in an unknown current: after one dive, after a turn, after two headings | `tests/surfacing.rs` | 5 % of the way, 20 seeds |
//! | a promise of the sea trials is judged by its worst water, and can fail | `tests/trials.rs` | counts by hand |
//! | geometry to coefficients: spheroid, strips, thin plates, scaling; exact derivatives | `tests/coefficients.rs` | 1e-9: quadrature; 1e-7: differences |
//! | polar, eqs (10)–(13), (17) and the ideal range, against searches and as printed | `tests/performance.rs` | 1e-9; 1e-12: rounding |
//! | a realistic yo against the flown one | `tests/performance.rs` | 1 %: noise, an apogee that is not symmetric |
//! | the paper's trends with geometry, and where they do not hold | `tests/trends.rs` | sign |
//! | sensitivities by nested dual numbers against central differences of everything anew | `tests/sensitivity.rs` | the differences' own error |
//! | the best geometry: the paper's conclusions, limits kept, the same bits, its file reads back | `tests/design.rs` | a bound reached; 1e-12 |
//! | Seawing's published spiral | `tests/seawing.rs` | 2 %: published digits, another drag law |

pub mod analysis;
pub mod cli;
pub mod files;
pub mod flight;
pub mod model;
pub mod pages;
pub mod parallel;
pub mod studies;
