//! Prints the layouts with which a population starts, as a JSON array of arrays of
//! cells: `starting_layouts INSTANCE.npz random|feasible COUNT SEED`.

use sonarfleet::placement::population::Start;
use sonarfleet::placement::{PlacementProblem, instance};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, start, count, seed] = &arguments[..] else {
        return Err("usage: starting_layouts INSTANCE.npz random|feasible COUNT SEED".into());
    };
    let start = match start.as_str() {
        "random" => Start::Random,
        "feasible" => Start::Feasible,
        other => return Err(format!("`{other}` is neither `random` nor `feasible`").into()),
    };
    let problem = PlacementProblem::new(&instance::read(path)?)?;
    let layouts = start.layouts(&problem, count.parse()?, seed.parse()?);
    println!("{}", serde_json::to_string(&layouts)?);
    Ok(())
}
