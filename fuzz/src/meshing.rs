//! Random planar straight-line graphs through every mesher: a mesh with its certificate, or a typed error.

use biting::domain::{Domain, Pslg, repair};
use biting::geometry::DVec2;
use biting::meshers::{Budget, MESHERS, Parameters, Request, Trace};
use biting::Case;
use biting::spacing::{self, Options, Spacing};

/// Pairs (t, c_b): the quality of the theorem, the middle, and the coarsest.
const PAIRS: [(f64, f64); 3] = [(0.25, 0.25), (0.3, 0.6), (0.25, 1.0)];
const SPECS: [&str; 3] = ["lfs", "uniform:0.4", "expr:0.05 + 0.2*(x*x + y*y)"];
/// Inputs that would take more are passed over: many small ones find more than few large ones.
const MOST_TRIANGLES: f64 = 150.0;
/// So are inputs with features closer than this: it takes the spacing seconds to tell that their triangles are too many.
const SMALLEST_FEATURE: f64 = 1.0 / 25.0;
/// The index of gradient limiting grows with 1 / (1 − k)²: at the default of 0.9 it takes most of the time.
const LIMIT_FACTOR: f64 = 0.5;

/// The numbers that the input still holds.
struct Bytes<'a>(std::slice::Iter<'a, u8>);

impl Bytes<'_> {
    fn next(&mut self) -> Option<usize> {
        self.0.next().copied().map(usize::from)
    }

    fn pick<'a, T>(&mut self, among: &'a [T]) -> Option<&'a T> {
        self.next().map(|byte| &among[byte % among.len()])
    }

    /// A point of the unit square, on a grid of 16 lines a side where `coarse`, else of 256.
    fn point(&mut self, coarse: bool) -> Option<DVec2> {
        let first = self.next()?;
        let (x, y, most) = if coarse {
            (first / 16, first % 16, 15.0)
        } else {
            (first, self.next()?, 255.0)
        };
        Some(DVec2::new(x as f64, y as f64) / most)
    }
}

/// Mesher, pair, spacing and grid, then rings, chains, lone vertices and holes till the bytes end.
pub fn pslg(data: &[u8]) {
    let mut bytes = Bytes(data.iter());
    let head = (|| {
        let entry = bytes.pick(MESHERS)?;
        Some((
            entry,
            *bytes.pick(&PAIRS)?,
            *bytes.pick(&SPECS)?,
            bytes.next()? % 2 == 0,
        ))
    })();
    let Some((entry, (t, c_b), spec, coarse)) = head else {
        return;
    };
    let pslg = graph(&mut bytes, coarse);
    let Ok(domain) = Domain::new(pslg.clone()).or_else(|_| Domain::new(repair(pslg).0)) else {
        return;
    };
    if smallest_feature(&domain) < SMALLEST_FEATURE {
        return;
    }
    let options = Options {
        limit_factor: LIMIT_FACTOR,
        ..Options::new(t, c_b)
    };
    let Ok(case) = Case::with(domain, spec, c_b, &options) else {
        return;
    };
    let Ok(integral) = spacing::integrate(&*case.spacing.function, &case.domain, 0.2) else {
        return;
    };
    if spacing::estimate_triangles(integral.value, c_b) > MOST_TRIANGLES {
        return;
    }
    let request = Request {
        seed: 1,
        budget: Budget {
            max_vertices: Some(10 * MOST_TRIANGLES as usize),
            ..Budget::default()
        },
        ..case.request()
    };
    let mesher = (entry.make)(&Parameters::new()).expect("defaults are valid");
    match case.mesh_as(&*mesher, &request, &mut Trace::default()) {
        Ok(mesh) => {
            let (_, certificate) = case.judge_of(&mesh, &*mesher);
            let broken: Vec<_> = certificate.broken().collect();
            assert!(broken.is_empty(), "{}: {broken:#?}", entry.name);
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// The least lfs at a vertex.
fn smallest_feature(domain: &Domain) -> f64 {
    spacing::lfs_of(domain).map_or(0.0, |lfs| {
        let at_vertices = domain.vertices().iter().map(|x| lfs.at(*x));
        at_vertices.fold(f64::INFINITY, f64::min)
    })
}

fn graph(bytes: &mut Bytes, coarse: bool) -> Pslg {
    let mut pslg = Pslg::new("fuzz");
    // The first part is a ring, else hardly any graph would hold a face.
    let mut kind = Some(0);
    while let Some(known) = kind {
        let count = match known % 4 {
            2 | 3 => 1,
            _ => 3 + bytes.next().unwrap_or(0) % 14,
        };
        let points: Vec<DVec2> = (0..count).map_while(|_| bytes.point(coarse)).collect();
        match known % 4 {
            0 => pslg.add_ring(points, 1),
            1 => pslg.add_chain(points, 2),
            2 => points.into_iter().for_each(|p| {
                pslg.add_vertex(p);
            }),
            _ => points.into_iter().for_each(|p| pslg.add_hole(p)),
        }
        kind = bytes.next();
    }
    pslg
}
