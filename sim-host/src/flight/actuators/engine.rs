//! The buoyancy engine in flight: how much flows.

use super::super::{Faults, TICK_S};
use crate::model::vehicle::{Buoyancy, EngineKind};

/// Pressure at which a leak has the rate it is given by, Pa.
const LEAK_PRESSURE_PA: f64 = 1e6;

/// What the engine remembers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Engine {
    /// Volume asked for since the piston last stood, m³.
    demand_m3: f64,
    /// The demand has left the dead zone.
    running: bool,
    /// Sea water taken in, m³.
    pub(super) leaked_m3: f64,
}

/// Flows that hold for one tick, m³/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flow {
    /// What pump, valve or motor move on command, out positive.
    pub(super) driven_m3_s: f64,
    /// Change of displaced volume, faults included.
    pub(super) displaced_m3_s: f64,
}

impl Engine {
    /// What flows during a tick, from `vbd_m3` on, at a gauge pressure and a time after the start.
    pub(super) fn flow(
        &mut self,
        buoyancy: &Buoyancy,
        faults: &Faults,
        commanded_m3_s: f64,
        (vbd_m3, pressure_pa, time_s): (f64, f64, f64),
    ) -> Flow {
        let (pump, bleed) = (buoyancy.pump_rate_at_m3_s(pressure_pa), buoyancy.bleed_rate_at_m3_s(pressure_pa));
        let [low, high] = buoyancy.volume_m3;
        let within = |rate: f64| rate.clamp(((low - vbd_m3) / TICK_S).min(0.0), ((high - vbd_m3) / TICK_S).max(0.0));
        let driven_m3_s = within(self.outside_dead_zone(buoyancy, commanded_m3_s).clamp(-bleed, pump));
        let gives_way = faults.uncommanded_bleed.at(time_s) * bleed / buoyancy.bleed_rate_m3_s;
        let leak = faults.leak.at(time_s) * (pressure_pa / LEAK_PRESSURE_PA).sqrt();
        self.leaked_m3 += leak * TICK_S;
        Flow { driven_m3_s, displaced_m3_s: within(driven_m3_s - gives_way) - leak }
    }

    /// The command, or nothing while what it adds up to is not worth a move of the piston.
    fn outside_dead_zone(&mut self, buoyancy: &Buoyancy, commanded_m3_s: f64) -> f64 {
        let EngineKind::Piston { dead_zone_m3 } = buoyancy.engine.kind else { return commanded_m3_s };
        if commanded_m3_s == 0.0 || commanded_m3_s * self.demand_m3 < 0.0 {
            (self.demand_m3, self.running) = (0.0, false);
        }
        self.demand_m3 += commanded_m3_s * TICK_S;
        self.running |= self.demand_m3.abs() >= dead_zone_m3;
        if self.running { commanded_m3_s } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::Seep;
    use crate::model::vehicle::Vehicle;

    const DEEP: (f64, f64, f64) = (0.0, 2e6, 100.0);

    fn slocum() -> Buoyancy {
        Vehicle::load("slocum-paper").unwrap().buoyancy.unwrap()
    }

    #[test]
    fn rates_and_ends_of_the_range_hold() {
        let (buoyancy, none) = (slocum(), Faults::default());
        let mut engine = Engine::default();
        let mut flow = |command, vbd_m3| engine.flow(&buoyancy, &none, command, (vbd_m3, 2e6, 0.0)).displaced_m3_s;
        assert_eq!(flow(1.0, 0.0), buoyancy.pump_rate_m3_s);
        assert_eq!(flow(-1.0, 0.0), -buoyancy.bleed_rate_m3_s);
        assert_eq!(flow(1.0, 3e-4), 0.0, "full");
        assert_eq!(flow(-1.0, -3e-4), 0.0, "empty");
        assert!((flow(1.0, 2.99e-4) * TICK_S - 1e-6).abs() < 1e-12, "what is left");
    }

    #[test]
    fn a_demand_within_the_dead_zone_moves_no_piston() {
        let mut buoyancy = slocum();
        buoyancy.engine.kind = EngineKind::Piston { dead_zone_m3: 42e-6 };
        let none = Faults::default();
        let mut engine = Engine::default();
        let mut driven = |command| engine.flow(&buoyancy, &none, command, DEEP).driven_m3_s;
        // 42 cc at 40 cc/s: begun in the fifth tick.
        let rates = [(); 5].map(|()| driven(40e-6));
        assert_eq!(rates, [0.0, 0.0, 0.0, 0.0, 40e-6]);
        assert_eq!(driven(1e-6), 1e-6, "under way, any rate will do");
        assert_eq!(driven(-40e-6), 0.0, "and back is a new move");
        assert_eq!([driven(0.0), driven(-40e-6)], [0.0, 0.0]);
    }

    #[test]
    fn a_leak_is_weight_that_the_potentiometer_does_not_show() {
        let (buoyancy, mut engine) = (slocum(), Engine::default());
        let leak = Faults { leak: Seep { rate_m3_s: 1e-6, from_s: 50.0 }, ..Faults::default() };
        assert_eq!(engine.flow(&buoyancy, &leak, 0.0, (0.0, 4e6, 49.0)).displaced_m3_s, 0.0, "not yet");
        // Flow goes with the square root of pressure.
        let flow = engine.flow(&buoyancy, &leak, 0.0, (0.0, 4e6, 50.0));
        assert_eq!(flow, Flow { driven_m3_s: 0.0, displaced_m3_s: -2e-6 });
        assert_eq!(engine.leaked_m3, 2e-6 * TICK_S);
    }

    #[test]
    fn an_uncommanded_bleed_ends_where_the_range_ends() {
        let (buoyancy, mut engine) = (slocum(), Engine::default());
        let bleed = Faults { uncommanded_bleed: Seep { rate_m3_s: 1e-6, from_s: 0.0 }, ..Faults::default() };
        assert_eq!(engine.flow(&buoyancy, &bleed, 0.0, DEEP).displaced_m3_s, -1e-6);
        let against = engine.flow(&buoyancy, &bleed, 3e-6, DEEP);
        assert_eq!((against.driven_m3_s, against.displaced_m3_s), (3e-6, 3e-6 - 1e-6), "the pump works against it");
        assert_eq!(engine.flow(&buoyancy, &bleed, 0.0, (-3e-4, 2e6, 0.0)).displaced_m3_s, 0.0, "empty");
    }
}
