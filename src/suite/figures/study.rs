//! Figures of the study: what the sweep measured, as it would stand in the paper, and one domain by every mesher.

use super::Material;
use super::drawing::{Drawing, Numbers, Picture};
use super::run::short;
use crate::Case;
use crate::domain::{self, Domain};
use crate::geometry::DVec2;
use crate::mesh::Mesh;
use crate::meshers::{MESHERS, Parameters};
use crate::quality::shape::angles_deg;
use crate::spacing::{self, Ingredients, Options, Spacing, Spec, lfs_of};
use crate::suite::analysis::measures::SIZE_RATIO;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::series::{TimeSeries, time_series};
use crate::suite::analysis::summary::{Grid, Setting, measured, setting};
use crate::suite::charts;
use crate::suite::rows::numbers::median;
use crate::suite::rows::record::{Cell, Row};
use crate::suite::run::measure::fingerprint;
use crate::suite::run::plan::Section;
use serde_json::Value;
use std::sync::Arc;

/// The measured smallest angle against the bound.
pub(super) fn angle(material: &Material) -> Result<Drawing<'_>, String> {
    let sweep = material.sweep()?;
    let points = |row: &Row| {
        let report = measured(row)?;
        let angle = report.statistics.min_angle_free_deg?;
        Some((
            report.t_effective,
            angle,
            angle - report.min_angle_bound_deg,
            setting(report),
        ))
    };
    let grid = all_of_grid(sweep);
    let points: Vec<_> = grid.rows.iter().filter_map(|row| points(row)).collect();
    let worst = |wanted: bool| {
        let own = points
            .iter()
            .filter(move |point| (point.3 == Setting::Papers) == wanted);
        (
            own.clone().count(),
            own.map(|point| point.2).fold(f64::INFINITY, f64::min),
        )
    };
    let ((papers, margin), (others, other_margin)) = (worst(true), worst(false));
    let caption = format!(
        "The smallest angle of each mesh of the sweep against its t, over the bound asin(1/2 − t) of Theorem 6.8; triangles at input \
         angles under 60° are left out. Points of different c_b are moved apart sideways. Filled: {papers} meshes for which the \
         hypotheses hold, the stated ones and the one that is not (circles of neighbouring input vertices do not meet low); the \
         nearest of them to the bound is {}° above it. Hollow: {others} meshes for which one fails; there it is {}°.",
        short(margin),
        short(other_margin)
    );
    let values = points
        .iter()
        .map(|point| Value::from(vec![digits(point.0), digits(point.1)]));
    let numbers = Numbers::default()
        .with("points", points.len())
        .number("least_margin_where_hypotheses_hold_deg", margin)
        .number("least_margin_elsewhere_deg", other_margin)
        .with("hash", super::page::hash(&Value::from(values.collect::<Vec<_>>())));
    Ok(Drawing {
        picture: Picture::Chart(Box::new(|stem| charts::smallest_angle(&all_of_grid(sweep), stem))),
        caption,
        numbers,
        commands: vec![SWEEP.into()],
    })
}

/// What the rows of the study were made by.
const SWEEP: &str = "cargo run --release -- sweep";

fn all_of_grid(sweep: &Results) -> Grid<'_> {
    Grid::of(
        sweep
            .grids(Section::Angle)
            .iter()
            .flat_map(|(_, grid)| grid.rows.iter().copied()),
    )
}

/// Six digits are more than a chart shows.
fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Triangles over ∫ dA / f² against t and c_b.
pub(super) fn size(material: &Material) -> Result<Drawing<'_>, String> {
    let sweep = material.sweep()?;
    let grids = sweep.grids(Section::Size);
    let Some((title, first)) = grids.first() else {
        return Err("the sweep has no grid of t and c_b".into());
    };
    let mut medians = Vec::new();
    for (t, c_b) in first
        .ts
        .iter()
        .flat_map(|t| first.c_bs.iter().map(move |c_b| (*t, *c_b)))
    {
        let ratio = first.median(t, c_b, SIZE_RATIO.value);
        medians.extend(ratio.map(|ratio| (t, c_b, ratio)));
    }
    let scaled: Vec<f64> = medians.iter().map(|(_, c_b, ratio)| ratio * c_b * c_b).collect();
    let (least, most) = (
        scaled.iter().copied().fold(f64::INFINITY, f64::min),
        scaled.iter().copied().fold(0.0, f64::max),
    );
    let caption = format!(
        "Size of the mesh beside what the spacing asks for: triangles / ∫dA/f² against t, one line for each c_b; medians over \
         domains, one panel for each family of spacings. Theorem 5.11 has a constant above it, Lemma 5.10 one below. It falls \
         as c_b⁻²: for `{title}`, c_b² times it lies between {} and {} for all {} pairs of t and c_b.",
        short(least),
        short(most),
        medians.len()
    );
    let values = medians
        .iter()
        .map(|(t, c_b, ratio)| Value::from(vec![*t, *c_b, digits(*ratio)]));
    let numbers = Numbers::default().with("t_c_b_median", values.collect::<Vec<_>>());
    Ok(Drawing {
        picture: Picture::Chart(Box::new(|stem| {
            charts::against_t(&sweep.grids(Section::Size), &SIZE_RATIO, stem)
        })),
        caption,
        numbers,
        commands: vec![SWEEP.into()],
    })
}

/// The step whose time is shown beside the whole.
const TRIANGULATION: &str = "delaunay_triangulation";

/// Steps that take less of the whole, in the median, are not drawn: they would stretch the axis over what matters.
const LEAST_SHARE: f64 = 0.01;

/// Time per triangle against size, with the triangulation's own beside it.
pub(super) fn time(material: &Material) -> Result<Drawing<'_>, String> {
    let sweep = material.sweep()?;
    let series = time_series(&sweep.ours(Section::Time));
    let whole = series.first().ok_or("the sweep has no timed runs")?;
    let triangulation = series.iter().find(|series| series.name == TRIANGULATION);
    let triangulation = triangulation.ok_or("the timed runs do not say how long the triangulation took")?;
    let share = |part: &TimeSeries| {
        let shares = whole
            .points
            .iter()
            .zip(&part.points)
            .map(|(whole, part)| part.1 / whole.1);
        median(shares.collect()).unwrap_or(0.0)
    };
    let (shown, left_out): (Vec<_>, Vec<_>) = series.iter().cloned().partition(|series| share(series) >= LEAST_SHARE);
    let left_out: Vec<String> = left_out.iter().map(|series| series.name.replace('_', " ")).collect();
    let growth = match whole.fit().zip(triangulation.fit()) {
        Some((whole, part)) => format!(
            "The whole grows as triangles to the power {}, the triangulation to {}",
            short(whole.slope),
            short(part.slope)
        ),
        None => "They are too few to fit a line".into(),
    };

    let caption = format!(
        "Time of biting for each triangle of the mesh against its size, whole and by step, the Delaunay triangulation's own among the \
         steps; with fitted lines and their slopes. Runs on one core whose repeats spread by less than 0.1 of their median: {}; f and its \
         limiting are made before and not counted. {growth}; the triangulation takes {} % of it in the median. \
         Not drawn, since they take less than {} %: {}.",
        whole.points.len(),
        short(100.0 * share(triangulation)),
        short(100.0 * LEAST_SHARE),
        left_out.join(", ")
    );
    let values = |series: &TimeSeries| {
        let points = series
            .points
            .iter()
            .map(|(triangles, seconds)| Value::from(vec![*triangles, digits(*seconds)]));
        Value::from(points.collect::<Vec<_>>())
    };
    let numbers = series.iter().fold(Numbers::default(), |numbers, series| {
        numbers.with(&series.name, values(series))
    });
    Ok(Drawing {
        picture: Picture::Chart(Box::new(move |stem| charts::time_per_triangle(&shown, stem))),
        caption,
        numbers,
        commands: vec![SWEEP.into()],
    })
}

/// The domain of the page of meshers, and what is asked of them: triangles enough to show what they do, few enough to be seen.
const SHOWN: &str = "plate-hole";
const SPACING: &str = "min(lfs, uniform:0.12)";
const T: f64 = 0.25;
const C_B: f64 = 0.75;

/// The domain by every mesher, under its name.
fn by_every_mesher() -> Result<Vec<(&'static str, Mesh)>, String> {
    let domain = domain::load(SHOWN).map_err(|error| error.to_string())?;
    let case = Case::new(domain, SPACING, T, C_B).map_err(|error| error.to_string())?;
    let made = MESHERS.iter().map(|entry| {
        let told = |error: String| format!("{} on {SHOWN}: {error}", entry.name);
        let mesher = (entry.make)(&Parameters::new()).map_err(told)?;
        Ok((
            entry.name,
            case.mesh(&*mesher).map_err(|error| told(error.to_string()))?,
        ))
    });
    made.collect()
}

fn smallest_angle_deg(mesh: &Mesh) -> f64 {
    let all = (0..mesh.triangles.len()).flat_map(|t| angles_deg(mesh.corners(t)));
    all.fold(180.0, f64::min)
}

/// One domain by every mesher of this crate, for the same edge length.
pub(super) fn meshers(_: &Material) -> Result<Drawing<'static>, String> {
    let made = by_every_mesher()?;
    let told = |(name, mesh): &(&str, Mesh)| {
        let angle = smallest_angle_deg(mesh);
        format!(
            "{name}, {} triangles, smallest angle {}°",
            mesh.triangles.len(),
            short(angle)
        )
    };
    let each: Vec<String> = made.iter().map(told).collect();
    let caption = format!(
        "`{SHOWN}` by the {} meshers of this crate with their defaults, each asked for the same edge length c_b f: f = `{SPACING}`, \
         t = {T}, c_b = {C_B}. {}. Triangles are coloured by their smallest angle.",
        made.len(),
        each.join("; ")
    );
    let numbers = made.iter().fold(Numbers::default(), |numbers, (name, mesh)| {
        let own = Numbers::default().with("triangles", mesh.triangles.len());
        numbers.with(
            name,
            own.number("smallest_angle_deg", smallest_angle_deg(mesh))
                .with("mesh", fingerprint(mesh)),
        )
    });
    let commands = made.iter().map(|(name, _)| {
        let options = Cell::new(SHOWN, name, SPACING, T, C_B).options();
        format!("cargo run --release -- mesh {SHOWN} --mesher {name}{options} --out {name}.svg")
    });
    let commands = commands.collect();
    let picture = move |stem: &std::path::Path| {
        let titled: Vec<_> = made.iter().map(|(name, mesh)| (*name, mesh)).collect();
        ["svg", "png"]
            .iter()
            .try_for_each(|ending| charts::draw_mesh_sheet(&titled, &stem.with_extension(ending)))
    };
    Ok(Drawing {
        picture: Picture::Chart(Box::new(picture)),
        caption,
        numbers,
        commands,
    })
}

/// The domain whose spacing is shown, and u: a front across the plate, beside the hole and through its arms.
const MAPPED: &str = "plate-hole";
const SOLUTION: &str = "hessian:tanh((x - 0.35*y - 0.1)/0.05);eps=0.02;max=0.5";

/// lfs, nsf, their minimum, and what is left of it once limited.
pub(super) fn spacing(_: &Material) -> Result<Drawing<'static>, String> {
    let domain = domain::load(MAPPED).map_err(|error| error.to_string())?;
    let options = Options::new(T, C_B);
    let f = spacing::build(SOLUTION, &domain, &options).map_err(|error| error.to_string())?;
    let spec = Spec::parse(SOLUTION).map_err(|error| error.to_string())?;
    let lfs = || Ok(Arc::new(lfs_of(&domain)?));
    let ingredients = Ingredients::new(&spec, &domain, options.lfs_cap, lfs).map_err(|error| error.to_string())?;
    let (Some(lfs), Some(nsf)) = (&ingredients.lfs, &ingredients.nsf) else {
        return Err(format!("{SOLUTION} has no lfs or nothing beside it"));
    };
    let share = decided_by(&**lfs, &**nsf, &domain);
    let caption = format!(
        "The control spacing of §2 on `{MAPPED}` for `{SOLUTION}`: lfs, which geometry asks for; nsf, which the second derivatives of u \
         ask for; gns, the smaller of the two; and f, the largest function below it that is α-Lipschitz with α = t / c_b = {}, up \
         to the limit factor. On {} % of the area geometry decides, on the rest the solution.",
        short(T / C_B),
        short(100.0 * share)
    );
    Ok(Drawing {
        caption,
        numbers: Numbers::default().number("share_decided_by_lfs", share),
        commands: vec![format!(
            "cargo run --release -- mesh {MAPPED}{} --maps spacing",
            Cell::new(MAPPED, "biting", SOLUTION, T, C_B).options()
        )],
        picture: Picture::Chart(Box::new(move |stem| {
            charts::spacing_maps(&domain, &ingredients, &*f.function, stem)
        })),
    })
}

/// Points along each side of the box at which the two are compared.
const ASKED: usize = 300;

/// The share of the domain on which the first is the smaller.
fn decided_by(first: &dyn Spacing, second: &dyn Spacing, domain: &Domain) -> f64 {
    let bounds = domain.bounds();
    let place = |k: usize| DVec2::new((k % ASKED) as f64 + 0.5, (k / ASKED) as f64 + 0.5) / ASKED as f64;
    let points = (0..ASKED * ASKED).map(|k| bounds.min + place(k) * bounds.size());
    let inside: Vec<DVec2> = points.filter(|&x| domain.contains(x)).collect();
    let decided = inside.iter().filter(|&&x| first.at(x) <= second.at(x)).count();
    decided as f64 / inside.len() as f64
}
