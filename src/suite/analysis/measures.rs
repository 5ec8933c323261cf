//! The numbers of a mesh that tables and charts show: one list, so that each has one title, one unit and one direction.

use crate::suite::analysis::contest::seconds_per_triangle;
use crate::suite::analysis::remarks::gap_share;
use crate::suite::fem::Solution;
use crate::suite::rows::record::Report;

/// A number of a report.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Its name, as a column has it.
    pub key: &'static str,
    /// What heads and axes say.
    pub title: &'static str,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// Title and unit where there is little room; empty where these two do.
    short: &'static str,
    /// With how many decimals it is written; without, with three digits that count.
    pub decimals: Option<usize>,
    /// Which way is better.
    pub better: Better,
    /// Where the number is.
    pub value: fn(&Report) -> Option<f64>,
}

/// Which way is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// A larger number.
    More,
    /// A smaller number.
    Less,
    /// Neither is.
    Neither,
}

impl PartialEq for Measure {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Measure {
    /// Title and unit.
    pub fn label(&self) -> String {
        match self.unit {
            "" => self.title.to_owned(),
            unit => format!("{} ({unit})", self.title),
        }
    }

    /// The same where there is little room.
    pub fn short_label(&self) -> String {
        match self.short {
            "" => self.label(),
            short => short.to_owned(),
        }
    }

    const fn short(self, short: &'static str) -> Self {
        Self { short, ..self }
    }

    /// How much better `own` is than `other`, negative where it is worse.
    pub fn gain(&self, own: f64, other: f64) -> f64 {
        match self.better {
            Better::More => own - other,
            Better::Less => other - own,
            Better::Neither => 0.0,
        }
    }
}

/// An angle of which a larger one is better, in degrees with two decimals.
const fn angle(key: &'static str, title: &'static str, value: fn(&Report) -> Option<f64>) -> Measure {
    Measure {
        decimals: Some(2),
        ..number(key, title, "°", Better::More, value)
    }
}

const fn number(
    key: &'static str,
    title: &'static str,
    unit: &'static str,
    better: Better,
    value: fn(&Report) -> Option<f64>,
) -> Measure {
    Measure {
        key,
        title,
        unit,
        short: "",
        decimals: None,
        better,
        value,
    }
}

/// Smallest angle, leaving out triangles at input angles under 60°.
pub const MIN_ANGLE: Measure = angle("min_angle_free_deg", "smallest angle", |report| {
    report.statistics.min_angle_free_deg
});

/// Mean over the triangles of their smallest angles.
pub const MEAN_ANGLE: Measure = angle("mean_min_angle_deg", "mean smallest angle", |report| {
    Some(report.statistics.mean_min_angle_deg)
})
.short("mean (°)");

/// 5th percentile of those.
pub const P05_ANGLE: Measure = angle("p05_min_angle_deg", "5th percentile", |report| {
    Some(report.statistics.p05_min_angle_deg)
});

/// Share of triangles whose smallest angle is under 20°.
pub const UNDER_20: Measure = number("under_20_percent", "under 20°", "%", Better::Less, |report| {
    Some(100.0 * report.statistics.share_under(20))
});

/// Share of triangles whose smallest angle is under 30°.
pub const UNDER_30: Measure = number("under_30_percent", "under 30°", "%", Better::Less, |report| {
    Some(100.0 * report.statistics.share_under(30))
});

/// Triangles.
pub const TRIANGLES: Measure = Measure {
    decimals: Some(0),
    ..number("triangles", "triangles", "", Better::Less, |report| {
        Some(report.statistics.triangles as f64)
    })
};

/// Triangles over ∫ dA / f² (Lemma 5.10, Theorem 5.11).
pub const SIZE_RATIO: Measure = number("size_ratio", "triangles / ∫dA/f²", "", Better::Less, |report| {
    Some(report.size_ratio)
});

/// Triangles over ∫ dA / lfs².
pub const SIZE_RATIO_LFS: Measure = number("size_ratio_lfs", "triangles / ∫dA/lfs²", "", Better::Less, |report| {
    Some(report.size_ratio_lfs)
});

/// Triangles over how many equilateral ones with edge c_b f there would be.
pub const SIZE_EFFICIENCY: Measure = number("size_efficiency", "size efficiency", "", Better::Less, |report| {
    Some(report.size_efficiency)
});

/// β of Definition 4.1, relative to the c_b with which the mesh was made.
pub const BETA: Measure = number("beta", "β", "", Better::Less, |report| report.statistics.beta);

/// Share of the circles that border a place which no circle covers.
pub const GAPS: Measure = number("gap_percent", "circles at a gap", "%", Better::Less, |report| {
    Some(100.0 * gap_share(report)?)
});

/// Percentiles of edge length over the length asked for.
pub const EDGES: [Measure; 3] = [
    number("edge_over_size_p05", "edge/s, 5 %", "", Better::Neither, |report| {
        Some(report.statistics.edge_over_size.as_ref()?.p05)
    }),
    number("edge_over_size_p50", "50 %", "", Better::Neither, |report| {
        Some(report.statistics.edge_over_size.as_ref()?.p50)
    }),
    number("edge_over_size_p95", "95 %", "", Better::Neither, |report| {
        Some(report.statistics.edge_over_size.as_ref()?.p95)
    }),
];

/// Time for each triangle.
pub const TIME: Measure = number("us_per_triangle", "time per triangle", "µs", Better::Less, |report| {
    Some(1e6 * seconds_per_triangle(report)?)
})
.short("µs/triangle");

/// Speed.
pub const SPEED: Measure = number("million_triangles_per_s", "speed", "10⁶/s", Better::More, |report| {
    Some(1e-6 / seconds_per_triangle(report)?)
});

/// What methods are compared by at equal edge length: angles, size, gaps, time.
pub const AT_EQUAL_SIZE: [Measure; 7] = [MIN_ANGLE, MEAN_ANGLE, P05_ANGLE, UNDER_30, TRIANGLES, BETA, TIME];

/// What explains differences at equal edge length.
pub const REASONS: [Measure; 5] = [GAPS, EDGES[0], EDGES[1], EDGES[2], SIZE_EFFICIENCY];

/// What they are compared by at equal triangle count, where β has no meaning: each method has a c_b of its own.
pub const AT_EQUAL_COUNT: [Measure; 5] = [MIN_ANGLE, MEAN_ANGLE, P05_ANGLE, UNDER_30, TIME];

/// What a Poisson problem says of a mesh, as numbers that do not change with size where a mesher makes meshes of one quality:
/// errors scaled by the power of unknowns with which they fall, iterations by that with which they grow.
pub const YIELDS: [Measure; 4] = [
    number(
        "energy_yield",
        "energy error · √unknowns",
        "",
        Better::Less,
        |report| {
            let solution = solution(report)?;
            Some(solution.energy_error / solution.energy_norm * unknowns(solution).sqrt())
        },
    ),
    number("l2_yield", "L2 error · unknowns", "", Better::Less, |report| {
        let solution = solution(report)?;
        Some(solution.l2_error / solution.l2_norm * unknowns(solution))
    }),
    number(
        "iterations_yield",
        "iterations / √unknowns",
        "",
        Better::Less,
        |report| {
            let solution = solution(report).filter(|solution| solution.converged)?;
            Some(solution.iterations as f64 / unknowns(solution).sqrt())
        },
    ),
    number("largest_eigenvalue", "largest eigenvalue", "", Better::Less, |report| {
        Some(solution(report)?.spectrum?.largest)
    }),
];

fn solution(report: &Report) -> Option<&Solution> {
    report.poisson.as_ref()
}

fn unknowns(solution: &Solution) -> f64 {
    solution.unknowns as f64
}
