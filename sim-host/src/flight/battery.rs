//! The battery: voltage under load, and the charge that a counter sees.

/// A battery in its present state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Battery {
    cells: Cells,
    full_v: f64,
    capacity_j: f64,
    voltage_v: f64,
    charge_c: f64,
}

/// How the voltage of a battery gives way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// Internal resistance, Ω.
    pub resistance_ohm: f64,
    /// Part of the open-circuit voltage that is lost, evenly, from full to empty.
    pub droop: f64,
}

impl Default for Cells {
    /// Chosen: a pack of 15 V falls to 10.5 V, half a volt above the fielded abort, when it is empty; many strings in parallel.
    fn default() -> Self {
        Self { resistance_ohm: 0.03, droop: 0.3 }
    }
}

impl Battery {
    pub(super) fn new(cells: Cells, full_v: f64, capacity_j: f64) -> Self {
        Self { cells, full_v, capacity_j, voltage_v: full_v, charge_c: 0.0 }
    }

    /// Gives `power_w` for `duration_s`, after `used_j` in all.
    pub(super) fn supply(&mut self, power_w: f64, duration_s: f64, used_j: f64) {
        let open_v = self.full_v * (1.0 - self.cells.droop * (used_j / self.capacity_j).min(1.0));
        // P = V (E − V)/R; a load beyond E²/4R finds the battery at its most, E/2.
        let left = (open_v * open_v - 4.0 * power_w * self.cells.resistance_ohm).max(0.0);
        self.voltage_v = 0.5 * (open_v + left.sqrt());
        self.charge_c += power_w / self.voltage_v * duration_s;
    }

    /// At its terminals, V.
    pub(super) fn voltage_v(&self) -> f64 {
        self.voltage_v
    }

    /// Drawn so far, C.
    pub(super) fn charge_c(&self) -> f64 {
        self.charge_c
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voltage_falls_under_load_and_with_charge() {
        let cells = Cells { resistance_ohm: 0.5, droop: 0.2 };
        let mut battery = Battery::new(cells, 15.0, 1e6);
        battery.supply(0.0, 1.0, 0.0);
        assert_eq!((battery.voltage_v(), battery.charge_c()), (15.0, 0.0));
        // 28 W at 14 V are 2 A, and 2 A take 1 V of 15 V.
        battery.supply(28.0, 10.0, 0.0);
        assert!((battery.voltage_v() - 14.0).abs() < 1e-12 && (battery.charge_c() - 20.0).abs() < 1e-12);
        battery.supply(0.0, 1.0, 5e5);
        assert!((battery.voltage_v() - 13.5).abs() < 1e-12, "half empty");
        battery.supply(1e4, 1.0, 0.0);
        assert_eq!(battery.voltage_v(), 7.5, "overloaded");
    }
}
