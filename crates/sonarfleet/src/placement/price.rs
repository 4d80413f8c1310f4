//! What a lack of connectivity costs while searching.

/// The price of λ₂ below the threshold τ, in `J_d` per unit of its relative lack.
///
/// It rises while layouts are infeasible and falls while they are feasible, so that a
/// search crosses the threshold again and again and meets the best layouts, which lie
/// on it, from both sides (Gendreau, Hertz & Laporte 1994, doi:10.1287/mnsc.40.10.1276).
/// A search that never leaves the feasible side gets stuck: every exchange of one
/// vehicle on the threshold either wastes λ₂ or breaks it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Price {
    threshold: f64,
    present: f64,
    lowest: f64,
    highest: f64,
}

/// The first price, its lowest and its highest, in `J_d` of one vehicle.
const FIRST: f64 = 15.0;
const LOWEST: f64 = 1.0;
const HIGHEST: f64 = 1000.0;

/// Share of the time spent below the threshold.
const SHARE_BELOW: f64 = 0.6;

/// Relative change of the price from one adjustment to the next.
const RATE: f64 = 0.01;

/// No layout falls below this share of the threshold: where the price is low, `J_d`
/// would scatter the vehicles, and gathering them again takes long.
const FLOOR: f64 = 0.8;

impl Price {
    /// The first price for a problem of so much `J_d` per vehicle.
    pub(super) fn new(threshold: f64, utility_per_vehicle: f64) -> Self {
        let [present, lowest, highest] =
            [FIRST, LOWEST, HIGHEST].map(|it| it * utility_per_vehicle);
        Self { threshold, present, lowest, highest }
    }

    /// What a layout pays.
    pub(super) fn of(&self, connectivity: f64) -> f64 {
        self.present * self.lack(connectivity)
    }

    /// λ₂ at which a layout that can afford `slack` pays just that.
    pub(super) fn least_connectivity(&self, slack: f64) -> f64 {
        self.threshold * (1.0 - slack / self.present).max(FLOOR)
    }

    /// Follows the connectivity that the search has.
    pub(super) fn adjust(&mut self, connectivity: f64) {
        let below = f64::from(u8::from(self.lack(connectivity) > 0.0));
        let factor = 1.0 + RATE * (below - SHARE_BELOW);
        self.present = (self.present * factor).clamp(self.lowest, self.highest);
    }

    fn lack(&self, connectivity: f64) -> f64 {
        (1.0 - connectivity / self.threshold).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_layout_can_afford_is_what_it_pays() {
        let price = Price::new(0.95, 0.9);
        for slack in [0.01, 0.5, 2.0] {
            let paid = price.of(price.least_connectivity(slack));
            assert!((paid - slack).abs() < 1e-9, "{paid} for {slack}");
        }
        assert_eq!(price.of(1.2).to_bits(), 0.0_f64.to_bits());
        assert!(price.least_connectivity(1e6) >= FLOOR * 0.95);
    }

    #[test]
    fn the_price_rises_below_the_threshold_and_falls_above_it() {
        let mut price = Price::new(0.95, 1.0);
        let first = price.of(0.9);
        price.adjust(0.9);
        assert!(price.of(0.9) > first);
        for _ in 0..10 {
            price.adjust(1.0);
        }
        assert!(price.of(0.9) < first);
    }
}
