//! `mesh DOMAIN`: one mesh, its files and its report.

use super::asked::Asked;
use super::exit::{Failure, Outcome};
use super::output::{self, STDOUT, Target, say, say_aside};
use super::values::{bytes, positive};
use super::watch;
use crate::charts;
use crate::domain::Domain;
use crate::experiment::machine;
use crate::experiment::measure::{self, Run};
use crate::experiment::prepare::{Prepared, Store};
use crate::experiment::record::{Cell, Report};
use crate::experiment::runner;
use crate::meshers::{Budget, Entry, MeshError, Mesher, Request};
use crate::spacing::{self, Ingredients, Spec};
use std::path::{Path, PathBuf};
use std::time::Duration;

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
    /// Most vertices a mesh may have
    #[arg(long, value_name = "N")]
    max_vertices: Option<usize>,
    /// Most seconds the mesher may take, and as many for domain, spacing and certificate each
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    max_seconds: Option<f64>,
    /// Most memory of the process, such as 4G
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    max_memory: Option<u64>,
    /// How close limiting comes to the largest spacing it could keep, below 1 [default: 0.9]
    #[arg(long, value_name = "SHARE", value_parser = positive)]
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
    let (entry, mesher) = runner::mesher(&cell).map_err(Failure::Input)?;
    let request = arguments.request();
    let (store, prepared) = arguments.prepare(&cell, &request.budget)?;
    output::say_notes(&store, &prepared.site.domain);
    let (prepared, run) = mesh_within(prepared, mesher, request)?;
    let (prepared, run, report) = judge_within(prepared, run, &cell, entry, &request.budget)?;
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
    let spec = Spec::parse(&prepared.spec).map_err(Failure::input)?;
    let site = &prepared.site;
    let ingredients =
        Ingredients::new(&spec, &site.domain, prepared.lfs_cap, || Ok(site.lfs.clone())).map_err(Failure::input)?;
    charts::spacing_maps(&site.domain, &ingredients, &*prepared.spacing, stem).map_err(Failure::input)?;
    Ok(["svg", "png"].map(|ending| stem.with_extension(ending)))
}

impl Arguments {
    /// Domain and spacing, within a budget that each of the two may use up.
    fn prepare(&self, cell: &Cell, budget: &Budget) -> Result<(Store, Prepared), Failure> {
        let (store, now) = (Store::new(self.limit_factor, self.repair), Duration::ZERO);
        let (name, asked) = (cell.domain.clone(), cell.clone());
        let reading = || format!("reading and checking {name}; raise the budget");
        let (store, domain) = watch::within(budget, now, reading, move || {
            let domain = store.domain(&asked.domain);
            (store, domain)
        })?;
        let (domain, asked) = (domain.map_err(Failure::input)?, cell.clone());
        let measuring = || {
            let place = shortest_segment(&domain);
            format!(
                "finding the local feature size of {}, before any meshing; {place}; raise the budget",
                cell.domain
            )
        };
        let (store, site) = watch::within(budget, now, measuring, move || {
            let site = store.site(&asked.domain);
            (store, site)
        })?;
        let (site, asked) = (site.map_err(Failure::input)?, cell.clone());
        let making = || {
            let expected = expected(site.integral_lfs.value, cell.c_b);
            format!(
                "making the spacing of {}, before any meshing; {}; with lfs as spacing {expected}; ask for a larger t / c_b or \
                 raise the budget",
                cell.domain,
                site.lfs.narrowest()
            )
        };
        let (store, prepared) = watch::within(budget, now, making, move || {
            let prepared = store.prepare_for_t(&asked);
            (store, prepared)
        })?;
        Ok((store, prepared.map_err(Failure::input)?))
    }

    fn request(&self) -> Request {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        Request {
            c_b: self.asked.c_b,
            seed: self.asked.seed,
            threads: self.threads.unwrap_or_else(cores).max(1),
            budget: Budget {
                max_vertices: self.max_vertices,
                max_seconds: self.max_seconds,
                max_memory: self.max_memory,
            },
        }
    }
}

/// A mesher that has not stopped by itself so long after its budget was used up is in a step that does not look.
const PATIENCE: Duration = Duration::from_secs(1);

/// No mesh has been seen to take less memory for a triangle: without a budget, none is begun that cannot end.
const LEAST_BYTES_PER_TRIANGLE: f64 = 100.0;

/// The number of triangles by the integral ∫dA/f², in words.
fn expected(integral: f64, c_b: f64) -> String {
    let triangles = spacing::estimate_triangles(integral, c_b);
    format!("about {triangles:.3e} triangles were to be expected (∫dA/f² = {integral:.3e})")
}

/// Meshes, and tells what was to be expected where a budget ends that.
fn mesh_within(prepared: Prepared, mesher: Box<dyn Mesher>, request: Request) -> Result<(Prepared, Run), Failure> {
    let integral = prepared.integral.value;
    let expected = expected(integral, request.c_b);
    let place = prepared.site.lfs.narrowest();
    let fits = LEAST_BYTES_PER_TRIANGLE * spacing::estimate_triangles(integral, request.c_b)
        <= machine::available_memory_bytes().map_or(f64::INFINITY, |bytes| bytes as f64);
    if request.budget == Budget::default() && !fits {
        return Err(Failure::Declined(format!(
            "declined: {expected}, more than memory holds; {place}; ask for a larger spacing or a larger c_b, move apart \
             what nearly touches, or set a budget such as --max-vertices to try all the same"
        )));
    }
    let told = || format!("meshing, in a step that does not place vertices; {place}; {expected}; raise the budget");
    let (prepared, run) = watch::within(&request.budget, PATIENCE, told, move || {
        let run = measure::run(&prepared, &*mesher, &request);
        (prepared, run)
    })?;
    let run = run.map_err(|error| match error {
        MeshError::Budget { .. } => Failure::Declined(format!("{error}; {place}; {expected}")),
        MeshError::Declined(_) => Failure::Declined(error.to_string()),
        _ => Failure::input(error),
    })?;
    Ok((prepared, run))
}

/// Judges within the same budget.
fn judge_within(
    prepared: Prepared,
    run: Run,
    cell: &Cell,
    entry: &'static Entry,
    budget: &Budget,
) -> Result<(Prepared, Run, Report), Failure> {
    let (triangles, place, cell) = (run.mesh.triangles.len(), prepared.site.lfs.narrowest(), cell.clone());
    let told = || format!("judging a finished mesh of {triangles} triangles; {place}; raise the budget");
    watch::within(budget, Duration::ZERO, told, move || {
        let report = measure::judge(&prepared, &cell, entry, &run, &machine::provenance());
        (prepared, run, report)
    })
}

/// Where a domain is likely to ask for the smallest triangles.
fn shortest_segment(domain: &Domain) -> String {
    let ends = (0..domain.segments().len()).map(|s| domain.ends(s));
    ends.min_by(|u, v| u[0].distance(u[1]).total_cmp(&v[0].distance(v[1])))
        .map_or_else(String::new, |[a, b]| {
            format!(
                "the shortest of {} segments goes from ({:?}, {:?}) to ({:?}, {:?})",
                domain.segments().len(),
                a.x,
                a.y,
                b.x,
                b.y
            )
        })
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
            report.seconds.total,
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
