//! Runs of biting that figures are found in: the paper to the letter, on domains that meet its hypotheses.

use super::labels;
use crate::Case;
use crate::delaunay::triangulate;
use crate::domain::{self, Domain, gallery};
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::geometry::tolerance::ALONG_SEGMENT;
use crate::mesh::{Mesh, Piece};
use crate::meshers::biting::{Biting, Corners, HeadOn, Order, TO_THE_LETTER};
use crate::meshers::{Bite, Budget, Reason, Request, Trace};
use crate::suite::rows::record::{Cell, quoted};
use crate::suite::run::measure::fingerprint;
use crate::theory::Rule;
use rayon::prelude::*;

/// What is asked of a run. Its spacing is lfs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Asked {
    /// Gallery name.
    pub domain: String,
    /// α c_b.
    pub t: f64,
    /// Biting constant.
    pub c_b: f64,
    /// Order of bites.
    pub order: Order,
}

impl Asked {
    /// The command that makes the same mesh.
    pub fn command(&self) -> String {
        let cell = Cell::new(&self.domain, "biting", "lfs", self.t, self.c_b);
        let options = cell.with(&[("order", &self.order())]).with(TO_THE_LETTER).options();
        format!(
            "cargo run --release -- mesh {}{options} --out mesh.svg",
            quoted(&self.domain)
        )
    }

    /// The name of the order of bites.
    fn order(&self) -> String {
        let name = serde_json::to_value(self.order).unwrap_or_default();
        name.as_str().unwrap_or_default().to_owned()
    }
}

/// A run with every bite.
pub(super) struct Run {
    pub asked: Asked,
    pub case: Case,
    pub bites: Vec<Bite>,
    pub mesh: Mesh,
    /// Triangles that fill the domain, for areas.
    pub ground: Vec<[DVec2; 3]>,
}

/// Larger runs show nothing that smaller ones do not, and take time.
const MOST_VERTICES: usize = 700;

impl Run {
    /// Bites and triangulates `domain`, the one that `asked` names.
    pub fn on(domain: Domain, asked: Asked) -> Result<Self, String> {
        let case = Case::new(domain, "lfs", asked.t, asked.c_b);
        Self::of(case.map_err(|error| format!("{}: {error}", asked.command()))?, asked)
    }

    /// The run of a case that is there already.
    fn of(case: Case, asked: Asked) -> Result<Self, String> {
        let told = |error: &dyn std::fmt::Display| format!("{}: {error}", asked.command());
        let request = Request {
            budget: Budget {
                max_vertices: Some(MOST_VERTICES),
                ..Budget::default()
            },
            ..case.request()
        };
        let mesher = Biting {
            rule: Rule::Earlier,
            order: asked.order,
            corners: Corners::Bite,
            head_on: HeadOn::Leave,
        };
        let mut trace = Trace::noting_bites();
        let mesh = case.mesh_as(&mesher, &request, &mut trace);
        let mesh = mesh.map_err(|error| told(&error))?;
        let domain = &*case.domain;
        let chains = Piece::chains(domain, vec![Vec::new(); domain.segments().len()]);
        let ground = triangulate(domain, domain.vertices().to_vec(), chains).map_err(|error| told(&error))?;
        Ok(Self {
            bites: trace.bites.unwrap_or_default(),
            ground: (0..ground.triangles.len()).map(|k| ground.corners(k)).collect(),
            mesh,
            case,
            asked,
        })
    }

    /// The biting circle of bite `k`.
    pub fn disc(&self, k: usize) -> Disc {
        Disc {
            centre: self.bites[k].centre,
            radius: self.bites[k].radius,
        }
    }

    /// The first `count` biting circles.
    pub fn discs(&self, count: usize) -> Vec<Disc> {
        (0..count).map(|k| self.disc(k)).collect()
    }

    /// The biting circle that there would be at `x`.
    pub fn disc_at(&self, x: DVec2) -> Disc {
        Disc {
            centre: x,
            radius: self.case.c_b * self.case.spacing.function.at(x),
        }
    }

    /// The bite before number `before`, centred on `segment`, whose circle leaves the segment at `point`.
    pub fn circle_through(&self, point: DVec2, segment: usize, before: usize) -> Option<usize> {
        let found = labels::circle_through(&self.bites[..before], self.case.domain.ends(segment), point);
        found.filter(|k| self.is_on(*k, segment))
    }

    /// Whether bite `k` is centred on `segment`.
    fn is_on(&self, k: usize, segment: usize) -> bool {
        let [a, b] = self.case.domain.ends(segment);
        match self.bites[k].reason {
            Reason::Progressive { segment: own } | Reason::Middle { segment: own, .. } => own == segment,
            Reason::InputVertex => [a, b].contains(&self.bites[k].centre),
            Reason::CutCorner | Reason::FrontVertex => false,
        }
    }

    /// Whether a figure on this segment reads well: the segment is level, with the domain above it.
    pub fn is_level(&self, segment: usize) -> bool {
        let [a, b] = self.case.domain.ends(segment);
        let above = a.midpoint(b) + 1e-3 * a.distance(b) * DVec2::Y;
        (a.y - b.y).abs() < ALONG_SEGMENT * a.distance(b)
            && self.case.domain.is_boundary(segment)
            && self.case.domain.contains(above)
    }

    /// What a caption says of it.
    pub fn told(&self) -> String {
        format!(
            "`{}`, f = lfs limited to the Lipschitz constant α = t / c_b, t = {} (effective {}), c_b = {}, order of bites `{}`: {} bites, {} triangles",
            self.asked.domain,
            short(self.asked.t),
            short(self.case.t()),
            short(self.asked.c_b),
            self.asked.order(),
            self.bites.len(),
            self.mesh.triangles.len()
        )
    }

    /// The mesh's fingerprint, as in the report of `mesh`.
    pub fn fingerprint(&self) -> String {
        fingerprint(&self.mesh)
    }
}

/// A number in a caption: four digits that count.
pub(super) fn short(value: f64) -> String {
    let digits = 3 - value.abs().max(1e-9).log10().floor() as i32;
    let text = format!("{value:.*}", digits.clamp(0, 9) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// (t, c_b), all with t ≤ 1/3 and c_b + t ≤ 1.
const SETTINGS: [(f64, f64); 4] = [(0.25, 0.75), (0.25, 0.5), (0.3, 0.5), (0.3, 0.4)];

/// The default, and the one that goes layer by layer.
const ORDERS: [Order; 2] = [Order::Largest, Order::Fifo];

/// Random domains tried of each kind.
const SEEDS: u64 = 6;
const RANDOM: [&str; 3] = [
    "random-convex:n=8,seed=",
    "random-pslg:kind=slits,seed=",
    "random-pslg:kind=islands,seed=",
];

/// The runs in which figures 2 to 5 are searched for: every domain of the gallery drawn by rule, and random ones, which have no
/// angle under 90°, each by every setting in two orders of bites. Those that need more than [`MOST_VERTICES`] are left out.
pub(super) fn searched() -> Vec<Run> {
    let by_rule = gallery::ENTRIES
        .iter()
        .filter(|entry| !entry.is_real())
        .map(|entry| entry.name.to_owned());
    let random = RANDOM
        .iter()
        .flat_map(|name| (0..SEEDS).map(move |seed| format!("{name}{seed}")));
    let names: Vec<String> = by_rule
        .filter(|name| !name.starts_with("random"))
        .chain(random)
        .collect();
    let runs = names.par_iter().flat_map_iter(|name| {
        let domain = domain::load(name).ok().filter(Domain::has_no_acute_angle);
        domain.into_iter().flat_map(move |domain| {
            let settings = SETTINGS.iter();
            settings.flat_map(move |&(t, c_b)| in_both_orders(&domain, name, t, c_b))
        })
    });
    runs.collect()
}

fn in_both_orders(domain: &Domain, name: &str, t: f64, c_b: f64) -> Vec<Run> {
    let Ok(case) = Case::new(domain.clone(), "lfs", t, c_b) else {
        return Vec::new();
    };
    let run = |order: Order| {
        let asked = Asked {
            domain: name.to_owned(),
            t,
            c_b,
            order,
        };
        Run::of(case.clone(), asked).ok()
    };
    ORDERS.into_iter().filter_map(run).collect()
}
