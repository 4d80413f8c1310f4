//! Seawater as sound meets it: speed, absorption, pressure.

mod absorption;
mod pressure;
mod sound_speed;

pub use absorption::{Absorption, francois_garrison_db_km, thorp_db_km};
pub use pressure::pressure_dbar;
pub use sound_speed::{SoundSpeedEquation, chen_millero_m_s, del_grosso_m_s, mackenzie_m_s};
