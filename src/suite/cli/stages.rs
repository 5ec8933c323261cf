//! The stages from a domain to a judged mesh, each within a budget, for `mesh` and `adapt`.

use super::budget;
use super::exit::Failure;
use crate::domain::Domain;
use crate::meshers::{Budget, Request};
use crate::spacing;
use crate::suite::peers::AnyMesher;
use crate::suite::rows::machine;
use crate::suite::rows::record::{Cell, Report};
use crate::suite::run::measure::{self, Run};
use crate::suite::run::prepare::{PrepareError, Prepared, Store};
use std::time::Duration;

/// A mesher that has not stopped by itself so long after its budget was used up is in a step that does not look.
const PATIENCE: Duration = Duration::from_secs(1);

/// No mesh has been seen to take less memory for a triangle: without a budget, none is begun that cannot end.
const LEAST_BYTES_PER_TRIANGLE: f64 = 100.0;

/// Domain and spacing, within a budget that each of the two may use up.
pub fn prepare(store: Store, cell: &Cell, budget: &Budget) -> Result<(Store, Prepared), Failure> {
    let reading = || format!("reading and checking {}; raise the budget", cell.domain);
    let (store, domain) = stage(store, cell, budget, reading, |store, cell| store.domain(&cell.domain))?;
    let domain = domain.map_err(Failure::input)?;
    let measuring = || {
        let place = shortest_segment(&domain);
        format!(
            "finding the local feature size of {}, before any meshing; {place}; raise the budget",
            cell.domain
        )
    };
    let (store, site) = stage(store, cell, budget, measuring, |store, cell| store.site(&cell.domain))?;
    let site = site.map_err(Failure::input)?;
    let making = || {
        let expected = expected(site.integral_lfs.value, cell.c_b);
        let (doing, remedy) = match &cell.adapt {
            None => ("making the spacing of {}, before any meshing", "a larger t / c_b"),
            Some(_) => (
                "adapting the spacing to the solution on {}",
                "a larger eps, fewer rounds",
            ),
        };
        let doing = doing.replace("{}", &cell.domain);
        let narrowest = site.lfs.narrowest();
        format!("{doing}; {narrowest}; with lfs as spacing {expected}; ask for {remedy} or raise the budget")
    };
    let (store, prepared) = stage(store, cell, budget, making, Store::prepare_for_t)?;
    let prepared = prepared.map_err(|error| match &error {
        PrepareError::Adaptation { ended, .. } if ended.is_budget => Failure::Declined(error.to_string()),
        _ => Failure::input(error),
    })?;
    Ok((store, prepared))
}

/// What `make` takes from the store for a cell, within the budget.
fn stage<T: Send + 'static>(
    store: Store,
    cell: &Cell,
    budget: &Budget,
    told: impl FnOnce() -> String,
    make: fn(&Store, &Cell) -> T,
) -> Result<(Store, T), Failure> {
    let cell = cell.clone();
    budget::within(budget, Duration::ZERO, told, move || {
        let made = make(&store, &cell);
        (store, made)
    })
}

/// The number of triangles by the integral ∫dA/f², in words.
fn expected(integral: f64, c_b: f64) -> String {
    let triangles = spacing::estimate_triangles(integral, c_b);
    format!("about {triangles:.3e} triangles were to be expected (∫dA/f² = {integral:.3e})")
}

/// Meshes, and tells what was to be expected where a budget ends that.
pub fn mesh(prepared: Prepared, mesher: AnyMesher, request: Request) -> Result<(Prepared, AnyMesher, Run), Failure> {
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
    let (prepared, mesher, run) = budget::within(&request.budget, PATIENCE, told, move || {
        let run = measure::run(&prepared, &mesher, &request);
        (prepared, mesher, run)
    })?;
    let run = run.map_err(|error| match error {
        _ if error.is_budget() => Failure::Declined(format!("{error}; {place}; {expected}")),
        _ if error.is_declined() => Failure::Declined(error.to_string()),
        _ => Failure::input(error),
    })?;
    Ok((prepared, mesher, run))
}

/// Judges within the same budget.
pub fn judge(
    (prepared, mesher): (Prepared, AnyMesher),
    run: Run,
    cell: &Cell,
    budget: &Budget,
) -> Result<(Prepared, Run, Report), Failure> {
    let (triangles, place, cell) = (run.mesh.triangles.len(), prepared.site.lfs.narrowest(), cell.clone());
    let told = || format!("judging a finished mesh of {triangles} triangles; {place}; raise the budget");
    budget::within(budget, Duration::ZERO, told, move || {
        let report = measure::judge(&prepared, &cell, &mesher, &run, &machine::provenance());
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
