/// Decibels per neper of amplitude, 20 lg e.
pub(crate) const DB_PER_NEPER: f64 = 8.685_889_638_065_037;
