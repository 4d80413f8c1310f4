//! Prints what files hold, and the column over a point at their first time:
//! `cargo run -p sonarfleet-ocean --example column LONGITUDE LATITUDE FILE…`.

use sonarfleet_ocean::io::{ForecastRequest, inspect, read_forecast};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = || arguments.next().unwrap_or_default().parse::<f64>();
    let (longitude_deg, latitude_deg) = (number()?, number()?);
    let files: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    for file in &files {
        eprint!("{}", inspect(file)?);
    }
    let request = ForecastRequest { required: &[], region: None, span: None };
    let forecast = read_forecast(&files, &request)?;
    let Some(column) = forecast.states[0].column(longitude_deg, latitude_deg) else {
        eprintln!("land, or outside the data");
        return Ok(());
    };
    println!("depth_m,temperature_c,salinity_psu,current_east_m_s,current_north_m_s");
    for (i, depth) in column.depth_m.iter().enumerate() {
        println!(
            "{depth},{},{},{},{}",
            column.temperature_c[i],
            column.salinity_psu[i],
            column.current_east_m_s[i],
            column.current_north_m_s[i]
        );
    }
    Ok(())
}
