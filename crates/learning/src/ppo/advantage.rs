//! Generalised advantage estimation.

/// Advantages Â(t) = δ(t) + γλ·Â(t + 1) within an episode, with
/// δ(t) = r(t) + γ·V(s(t + 1)) − V(s(t)) (Schulman et al. 2016, arXiv:1506.02438), of
/// one environment's steps in order.
///
/// `next_values` estimate the return after each step: 0 where the episode terminated,
/// the value of its last state where it was cut off. `ended` tells where an episode
/// terminated or was cut off, beyond which nothing is added.
pub fn generalised_advantages(
    rewards: &[f32],
    values: &[f32],
    next_values: &[f32],
    ended: &[bool],
    gamma: f32,
    gae_lambda: f32,
    advantages: &mut [f32],
) {
    let mut later = 0.0;
    for t in (0..rewards.len()).rev() {
        let delta = rewards[t] + gamma * next_values[t] - values[t];
        later = delta + if ended[t] { 0.0 } else { gamma * gae_lambda * later };
        advantages[t] = later;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;
    use sonarfleet::random::stream;

    /// Rounding of sums of fifty terms of size 1.
    const ROUNDING: f64 = 2e-5;

    /// The definition, Â(t) = Σ (γλ)ˡ δ(t + l) up to the episode's end.
    #[test]
    fn advantages_are_those_of_the_double_loop() {
        let mut random = stream(1, "test/advantage", 0);
        for _ in 0..50 {
            let length = 50;
            let mut draw = || (0..length).map(|_| random.random_range(-1.0..1.0)).collect();
            let (rewards, values): (Vec<f32>, Vec<f32>) = (draw(), draw());
            let next_values: Vec<f32> = draw();
            let ended: Vec<bool> = (0..length).map(|_| random.random_bool(0.1)).collect();
            let (gamma, lambda) = (0.97_f32, 0.9_f32);
            let mut advantages = vec![0.0; length];
            generalised_advantages(
                &rewards,
                &values,
                &next_values,
                &ended,
                gamma,
                lambda,
                &mut advantages,
            );
            for (t, &advantage) in advantages.iter().enumerate() {
                let mut expected = 0.0;
                for l in t..length {
                    let delta = f64::from(rewards[l])
                        + f64::from(gamma) * f64::from(next_values[l])
                        - f64::from(values[l]);
                    expected += (f64::from(gamma) * f64::from(lambda)).powi((l - t) as i32) * delta;
                    if ended[l] {
                        break;
                    }
                }
                assert!((f64::from(advantage) - expected).abs() < ROUNDING);
            }
        }
    }
}
