use std::time::Instant;

/// What a piece of work took.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    /// Seconds on the clock.
    pub(super) wall_s: f64,
    /// Seconds of processors, child processes included. Other programs on the machine
    /// lengthen it less than they lengthen the wall clock's.
    pub(super) cpu_s: f64,
}

impl Effort {
    /// Does a piece of work and says what it took. Where the system does not tell
    /// processor time, all threads are taken to be busy all the time.
    pub(super) fn of<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let (started, before) = (Instant::now(), processor_s());
        let result = work();
        let wall_s = started.elapsed().as_secs_f64();
        let cpu_s = match (before, processor_s()) {
            (Some(before), Some(after)) => after - before,
            _ => wall_s * rayon::current_num_threads() as f64,
        };
        (result, Self { wall_s, cpu_s })
    }
}

/// Processor time of this process and of its children that have ended, in user and
/// system mode, from Linux's `/proc/self/stat`.
fn processor_s() -> Option<f64> {
    const TICKS_PER_SECOND: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The second field, the program's name in brackets, may hold blanks.
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks = fields.split_whitespace().skip(11).take(4).map(str::parse::<f64>);
    Some(ticks.sum::<Result<f64, _>>().ok()? / TICKS_PER_SECOND)
}
