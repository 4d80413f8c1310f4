#![allow(missing_docs, clippy::all, clippy::pedantic)]
use sonarfleet::assignment::*;
use std::time::Instant;
fn main() {
    for path in std::env::args().skip(1) {
        let c = CostMatrix::read(&path).unwrap();
        for obj in [
            AssignmentObjective::Sum,
            AssignmentObjective::Power(1.5),
            AssignmentObjective::BottleneckThenSum,
        ] {
            if c.rows() > 2000 && obj != AssignmentObjective::Sum {
                continue;
            }
            let n = if c.rows() < 300 {
                200
            } else if c.rows() < 2000 {
                5
            } else {
                1
            };
            let mut best = f64::INFINITY;
            let mut a = None;
            for _ in 0..n {
                let t = Instant::now();
                a = Some(assign(&c, obj).unwrap());
                best = best.min(t.elapsed().as_secs_f64() * 1e3);
            }
            let a = a.unwrap();
            println!(
                "{path} {obj:?}: {best:.4} ms total {} largest {} certified {}",
                a.total, a.largest, a.certified
            );
        }
    }
}
