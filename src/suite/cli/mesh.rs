//! `mesh DOMAIN`: one mesh, its files and its report.

use super::asked::Asked;
use super::exit::{Failure, Outcome};
use super::output::{self, STDOUT, Target, say, say_aside};
use super::stages;
use super::values::{Limits, share};
use crate::meshers::Request;
use crate::spacing::{Ingredients, Spec};
use crate::suite::charts;
use crate::suite::rows::record::Report;
use crate::suite::run::prepare::{Prepared, Store};
use crate::suite::run::runner;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Arguments {
    /// A gallery name (`biting list`) or a file (.poly, .geojson)
    domain: String,
    /// The method; `biting list` shows all
    #[arg(long, default_value = "biting")]
    mesher: String,
    #[command(flatten)]
    asked: Asked,
    /// Threads a mesher may use; the mesh does not depend on it [default: all cores]
    #[arg(long)]
    threads: Option<usize>,
    /// A mesh file by its ending (.node .vtu .msh .obj .svg .png .json), the domain itself (.poly), or - for JSON on
    /// standard output; may be repeated
    #[arg(long, value_name = "FILE")]
    out: Vec<String>,
    /// Where to write the report, or - for standard output
    #[arg(long, value_name = "FILE.json")]
    report: Option<String>,
    /// Draw lfs, nsf, their minimum and f, which was limited, as maps to STEM.svg and STEM.png
    #[arg(long, value_name = "STEM")]
    maps: Option<PathBuf>,
    /// Mend what can be mended in a domain file, and say what was changed
    #[arg(long)]
    repair: bool,
    #[command(flatten)]
    limits: Limits,
    /// How close limiting comes to the largest spacing it could keep, below 1 [default: 0.9]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    limit_factor: Option<f64>,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let targets = Target::parse_all(&arguments.out)?;
    if let Some(both) = arguments
        .out
        .iter()
        .find(|name| arguments.report.as_ref() == Some(name))
    {
        return Err(Failure::Input(format!(
            "--out and --report both name {both}; write the report to a file of its own"
        )));
    }
    let cell = arguments.asked.cell(&arguments.domain, &arguments.mesher)?;
    let mesher = runner::mesher(&cell).map_err(Failure::Input)?;
    let request = arguments.request();
    let store = Store::new(arguments.limit_factor, arguments.repair);
    let (store, prepared) = stages::prepare(store, &cell, &request.budget)?;
    output::say_notes(&store, &prepared.site.domain);
    let (prepared, mesher, run) = stages::mesh(prepared, mesher, request)?;
    let (prepared, run, report) = stages::judge((prepared, mesher), run, &cell, &request.budget)?;
    let mut written = Vec::new();
    for target in &targets {
        written.extend(output::write(target, &prepared.site.domain, &run.mesh)?);
    }
    if let Some(name) = &arguments.report {
        let text = serde_json::to_string_pretty(&report).map_err(Failure::input)?;
        if name == STDOUT {
            output::write_out(&text)?;
        } else {
            output::write_file(name.as_ref(), &text)?;
            written.push(name.into());
        }
    }
    if let Some(stem) = &arguments.maps {
        written.extend(draw_maps(&prepared, stem)?);
    }
    let mut lines = summary(&report);
    lines.extend(written.iter().map(|path| format!("wrote {}", path.display())));
    if targets.contains(&Target::Stdout) || arguments.report.as_deref() == Some(STDOUT) {
        // Standard output carries the mesh or the report.
        say_aside(lines.join("\n"));
    } else {
        say(lines.join("\n"));
    }
    output::verdict(&report.certificate)
}

/// Draws what the spacing is made of.
fn draw_maps(prepared: &Prepared, stem: &Path) -> Result<[PathBuf; 2], Failure> {
    let spec = Spec::parse(&prepared.spacing.spec).map_err(Failure::input)?;
    let site = &prepared.site;
    let ingredients = Ingredients::new(&spec, &site.domain, prepared.spacing.lfs_cap, || Ok(site.lfs.clone()))
        .map_err(Failure::input)?;
    charts::spacing_maps(&site.domain, &ingredients, &*prepared.spacing.function, stem).map_err(Failure::input)?;
    Ok(["svg", "png"].map(|ending| stem.with_extension(ending)))
}

impl Arguments {
    fn request(&self) -> Request {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        Request {
            c_b: self.asked.c_b,
            seed: self.asked.seed,
            threads: self.threads.unwrap_or_else(cores).max(1),
            budget: self.limits.budget(),
        }
    }
}

/// A report in a few lines.
fn summary(report: &Report) -> Vec<String> {
    let statistics = &report.statistics;
    let params: Vec<String> = report
        .params
        .iter()
        .map(|(name, value)| {
            format!(
                "{name} {}",
                value.as_str().map_or_else(|| value.to_string(), str::to_owned)
            )
        })
        .collect();
    let sharp = match statistics.min_angle_free_deg {
        Some(free) if statistics.excused > 0 => {
            format!(
                "; {free:.2}° without the {} triangles at input angles under 60°",
                statistics.excused
            )
        }
        _ => String::new(),
    };
    vec![
        format!(
            "{}: {} triangles, {} vertices in {:.3} s by {} ({}), spacing {}, t = {:.4} (effective {:.4}), c_b = {:.4}",
            report.domain,
            statistics.triangles,
            statistics.vertices,
            report.times.as_ref().map_or(0.0, |times| times.seconds.total),
            report.mesher,
            params.join(", "),
            report.spacing,
            report.t,
            report.t_effective,
            report.c_b
        ),
        format!(
            "angles: smallest {:.2}° (bound {:.2}°{sharp}), mean of the smallest {:.2}°, largest {:.2}°",
            statistics.min_angle_deg,
            report.min_angle_bound_deg,
            statistics.mean_min_angle_deg,
            statistics.max_angle_deg
        ),
        format!(
            "size: {:.2} triangles / ∫dA/f², {:.2} triangles / ∫dA/lfs², efficiency {:.3}",
            report.size_ratio, report.size_ratio_lfs, report.size_efficiency
        ),
    ]
}
