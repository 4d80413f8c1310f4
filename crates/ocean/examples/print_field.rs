//! Prints the values of one variable of a NetCDF file, decoded, one per line:
//! `cargo run -p sonarfleet-ocean --example print_field FILE VARIABLE`.

use sonarfleet_ocean::OceanError;
use sonarfleet_ocean::io::read_field;
use std::path::Path;

fn main() -> Result<(), OceanError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, variable] = arguments.as_slice() else {
        eprintln!("usage: print_field FILE VARIABLE");
        return Ok(());
    };
    let field = read_field(Path::new(file), variable)?;
    for value in field.values {
        println!("{value}");
    }
    Ok(())
}
