//! One mesh and all that is known of it: what `mesh` and `sweep` share.

use crate::mesh::Mesh;
use crate::meshers::{Mesher, Request, Trace, resident_bytes};
use crate::suite::fem::{self, Problem, Solution};
use crate::suite::peers::{AnyMesher, PeerRun, RunError};
use crate::suite::rows::machine;
use crate::suite::rows::record::{Cell, Outside, Provenance, Report};
use crate::suite::rows::times::{Seconds, Times};
use crate::suite::run::prepare::{Prepared, Site};
use crate::theory::Promises;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::time::Instant;

/// A mesh as it came from its mesher, not yet judged.
#[derive(Debug)]
pub struct Run {
    /// The mesh.
    pub mesh: Mesh,
    /// Seconds, in all and by step, and memory.
    pub times: Times,
    /// Counts the mesher reports of itself.
    pub counts: BTreeMap<String, f64>,
    /// What a peer reports of its run besides.
    pub outside: Option<Outside>,
}

/// Meshes, and times that.
///
/// # Errors
/// The mesher's.
pub fn run(prepared: &Prepared, mesher: &AnyMesher, request: &Request) -> Result<Run, RunError> {
    match mesher {
        AnyMesher::Ours(mesher) => ours(prepared, &**mesher, request),
        AnyMesher::Peer(peer) => {
            let (domain, spacing) = (&prepared.site.domain, &*prepared.spacing.function);
            Ok(Run::of_peer(peer.run(
                domain,
                spacing,
                request,
                &prepared.size_field,
            )?))
        }
    }
}

fn ours(prepared: &Prepared, mesher: &dyn Mesher, request: &Request) -> Result<Run, RunError> {
    let mut trace = Trace::default();
    let case = prepared.case(request.c_b);
    let rss_before_bytes = resident_bytes().unwrap_or(0);
    let start = Instant::now();
    let mesh = case.mesh_as(mesher, request, &mut trace)?;
    let total = start.elapsed().as_secs_f64();
    let mut steps = Map::new();
    for (name, duration) in &trace.steps {
        let before = steps.get(*name).and_then(Value::as_f64).unwrap_or(0.0);
        steps.insert((*name).into(), Value::from(before + duration.as_secs_f64()));
    }
    let counts = trace.counts.into_iter();
    Ok(Run {
        mesh,
        times: Times {
            seconds: Seconds { total, steps },
            samples: Vec::new(),
            rss_before_bytes,
            peak_rss_bytes: machine::peak_rss_bytes(),
        },
        counts: counts.map(|(name, value)| (name.to_owned(), value)).collect(),
        outside: None,
    })
}

impl Run {
    /// Time and memory are what the peer reports: what we would measure has its process in it.
    fn of_peer(run: PeerRun) -> Self {
        let (mut counts, mut steps) = (BTreeMap::new(), Map::new());
        for (name, value) in run.counts {
            // What a peer counts is the same on each run, but where it counts seconds.
            match name.strip_prefix("seconds_") {
                Some(step) => drop(steps.insert(step.to_owned(), Value::from(value))),
                None => drop(counts.insert(name, value)),
            }
        }
        Self {
            mesh: run.mesh,
            times: Times {
                seconds: Seconds {
                    total: run.seconds,
                    steps,
                },
                samples: Vec::new(),
                rss_before_bytes: run.rss_before_bytes,
                peak_rss_bytes: run.peak_rss_bytes,
            },
            counts,
            outside: Some(Outside {
                version: run.version,
                set_up_seconds: run.set_up,
                repeats_differ: false,
            }),
        }
    }
}

/// Everything about a mesh: statistics, certificate, and what made it.
pub fn judge(prepared: &Prepared, cell: &Cell, mesher: &AnyMesher, run: &Run, provenance: &Provenance) -> Report {
    let (site, c_b) = (&*prepared.site, cell.c_b);
    let case = prepared.case(c_b);
    let t_effective = case.t();
    let triangles = run.mesh.triangles.len() as f64;
    let integral = prepared.integral.value;
    let size_ratio = triangles / integral;
    let (poisson, poisson_failed) = poisson(cell, site, run);
    let (statistics, certificate) = mesher.judge(&case, &run.mesh);
    Report {
        domain: site.domain.name().into(),
        mesher: cell.mesher.clone(),
        params: cell.complete(),
        spacing: prepared.spacing.spec.clone(),
        t: cell.t,
        t_effective,
        c_b,
        alpha: cell.t / c_b,
        seed: cell.seed,
        lfs_cap: prepared.spacing.lfs_cap,
        smallest_input_angle_deg: site.domain.smallest_input_angle_deg(),
        smallest_segment_angle_deg: site.domain.smallest_segment_angle_deg(),
        forced_pieces: run.mesh.forced_pieces,
        integral,
        integral_error: prepared.integral.error,
        integral_lfs: site.integral_lfs.value,
        size_ratio,
        size_ratio_lfs: triangles / site.integral_lfs.value,
        size_efficiency: size_ratio * 0.25 * 3.0f64.sqrt() * c_b * c_b,
        min_angle_bound_deg: Promises {
            rule: mesher.rule(),
            t: t_effective,
        }
        .min_angle_deg(),
        fingerprint: fingerprint(&run.mesh),
        statistics,
        times: Some(run.times.clone()),
        outside: run.outside.clone(),
        poisson,
        poisson_failed,
        rounds: prepared.rounds.to_vec(),
        counts: run.counts.clone(),
        certificate,
        provenance: Some(provenance.clone()),
    }
}

/// Solves the Poisson problem that a cell asks for, if it asks; or tells why it cannot be solved, as on a mesh that is none of
/// the domain.
fn poisson(cell: &Cell, site: &Site, run: &Run) -> (Option<Solution>, Option<String>) {
    let Some(name) = &cell.poisson else {
        return (None, None);
    };
    let solved = Problem::named(name, site.domain.bounds()).and_then(|problem| fem::solve(&run.mesh, &problem));
    match solved {
        Ok(solution) => (Some(solution), None),
        Err(error) => (None, Some(error.to_string())),
    }
}

/// A hash of the mesh's points and triangles, bit by bit, in hexadecimal: FNV-1a of 64 bits over their words. Equal
/// meshes have equal ones; different meshes different ones, but for chance.
pub fn fingerprint(mesh: &Mesh) -> String {
    let points = mesh
        .points
        .iter()
        .flat_map(|point| [point.x.to_bits(), point.y.to_bits()]);
    let corners = mesh.triangles.iter().flatten().map(|&corner| u64::from(corner));
    let hash = points.chain(corners).fold(0xcbf2_9ce4_8422_2325u64, |hash, word| {
        // Whole words instead of bytes; the rotation lets their high bits reach the low ones.
        (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29)
    });
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::DVec2;
    use crate::meshers;

    #[test]
    fn a_fingerprint_sees_one_bit_and_one_corner() {
        let mesh = Mesh {
            points: vec![DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE],
            triangles: vec![[0, 1, 2], [1, 3, 2]],
            ..Mesh::default()
        };
        let (mut moved, mut turned) = (mesh.clone(), mesh.clone());
        moved.points[3].y = 1.0f64.next_up();
        turned.triangles[1] = [3, 2, 1];
        let all = [&mesh, &moved, &turned].map(fingerprint);
        assert_eq!(all[0], fingerprint(&mesh.clone()));
        assert!(all[0] != all[1] && all[0] != all[2] && all[1] != all[2], "{all:?}");
    }

    #[test]
    fn defaults_complete_what_a_cell_names() {
        for entry in meshers::MESHERS {
            let mut cell = Cell::new("unit-square", entry.name, "lfs", 0.25, 0.5);
            let defaults = cell.complete();
            assert_eq!(defaults.len(), entry.parameters.len(), "{}", entry.name);
            assert!((entry.make)(&defaults).is_ok(), "{}: its defaults make it", entry.name);
            cell.params = defaults.clone();
            assert_eq!(cell.complete(), defaults);
        }
    }
}
