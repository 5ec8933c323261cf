//! One libFuzzer program for all targets; the environment variable `FUZZ_TARGET` names the one to run, `./run` sets it.
//!
//! A target holds if it returns. It panics where a promise breaks; libFuzzer adds hangs and memory above a limit.
#![no_main]

mod domains;
mod experiments;
mod meshes;
mod meshing;
mod scratch;
mod spacings;

use std::sync::OnceLock;

/// What a target does with bytes.
type Target = fn(&[u8]);

/// Every target: `./run` reads their names here, one a line.
const TARGETS: &[(&str, Target)] = &[
    ("poly", domains::poly),
    ("geojson", domains::geojson),
    ("triangle", meshes::triangle),
    ("vtu", meshes::vtu),
    ("msh", meshes::msh),
    ("obj", meshes::obj),
    ("json", meshes::json),
    ("spec", spacings::spec),
    ("expression", spacings::expression),
    ("plan", experiments::plan),
    ("rows", experiments::rows),
    ("pslg", meshing::pslg),
];

/// The target that the environment names.
fn chosen() -> Target {
    let name = std::env::var("FUZZ_TARGET").unwrap_or_default();
    match TARGETS.iter().find(|(known, _)| *known == name) {
        Some((_, target)) => *target,
        None => {
            let known: Vec<&str> = TARGETS.iter().map(|(known, _)| *known).collect();
            eprintln!("FUZZ_TARGET is `{name}`; set it to one of {}", known.join(", "));
            std::process::exit(2);
        }
    }
}

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    static CHOSEN: OnceLock<Target> = OnceLock::new();
    CHOSEN.get_or_init(chosen)(data);
});
