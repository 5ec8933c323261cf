//! Rows from their tables. What follows from other columns is worked out again by the formulas that made it.

use super::asked::outcome_word;
use super::beside::{BINS, SECONDS, SET_UP, STEP, bin_column};
use super::claims::{applies_column, broken_column, worst_column, worst_default};
use super::column::{Line, Table, TableError};
use super::meshes::solver_word;
use crate::meshers::{self, Mesher, Parameters, parameter_value};
use crate::quality::{Angles, Certificate, Check, Percentiles, Range, Seams, Statistics};
use crate::suite::fem::{Solution, Solver, Spectrum};
use crate::suite::rows::adapted::{Adapt, Round};
use crate::suite::rows::record::{Cell, Outcome, Outside, Report, Row, Try};
use crate::suite::rows::times::{Seconds, Times};
use crate::theory::{Claim, Promises};
use std::collections::HashMap;
use std::path::Path;

/// The mesher of ours that a cell names: of peers nothing is known but the paper's rule.
pub(super) fn method(cell: &Cell) -> Option<Box<dyn Mesher>> {
    (meshers::find(&cell.mesher)?.make)(&cell.params).ok()
}

/// The rows of a folder's tables, without times and what else stands beside `meshes.csv`.
pub(super) fn meshes(path: &Path) -> Result<Vec<Row>, TableError> {
    Table::read(path)?.lines().map(|line| row(&line)).collect()
}

fn row(line: &Line) -> Result<Row, TableError> {
    let cell = cell(line)?;
    let outcomes = [Outcome::Measured, Outcome::Skipped, Outcome::Declined, Outcome::Failed];
    let word = line.text("outcome").unwrap_or_default();
    let outcome = outcomes.into_iter().find(|outcome| outcome_word(*outcome) == word);
    let report = match line.text("fingerprint") {
        Some(_) => Some(report(line, &cell)?),
        None => None,
    };
    let integral = report.as_ref().map_or(0.0, |report| report.integral);
    let expected = match cell.triangles {
        Some(wanted) => wanted as f64,
        None => crate::spacing::estimate_triangles(integral, cell.c_b),
    };
    Ok(Row {
        key: line.get("key")?,
        group: line.get("group")?,
        outcome: outcome.ok_or_else(|| line.error(&format!("`{word}` is no outcome")))?,
        reason: line.maybe("reason")?,
        estimated_triangles: line.or("estimated_triangles", expected)?,
        tries: tries(line)?,
        cell,
        report,
    })
}

fn cell(line: &Line) -> Result<Cell, TableError> {
    let adapt = match line.maybe("adapt_eps")? {
        Some(eps) => Some(Adapt {
            eps,
            rounds: line.get("adapt_rounds")?,
            sample: line.flag("adapt_sample", false)?,
        }),
        None => None,
    };
    Ok(Cell {
        domain: line.get("domain")?,
        mesher: line.get("mesher")?,
        params: params(line)?,
        spacing: line.get("spacing")?,
        t: line.get("t")?,
        c_b: line.get("c_b")?,
        seed: line.or("seed", 0)?,
        lfs_cap: line.flag("lfs_cap", true)?,
        triangles: line.maybe("wanted_triangles")?,
        threads: line.or("threads", 1)?,
        poisson: line.maybe("problem")?,
        adapt,
        timed: line.flag("timed", false)?,
    })
}

fn params(line: &Line) -> Result<Parameters, TableError> {
    let all = line.text("params").into_iter().flat_map(|text| text.split(','));
    let one = |text: &str| {
        let (name, value) = text
            .split_once('=')
            .ok_or_else(|| line.error(&format!("`{text}` among `params` is no name=value")))?;
        Ok((name.to_owned(), parameter_value(value)))
    };
    all.map(one).collect()
}

fn tries(line: &Line) -> Result<Vec<Try>, TableError> {
    let all = line.text("tries").into_iter().flat_map(str::split_whitespace);
    let one = |text: &str| {
        let (c_b, triangles) = text.split_once(':')?;
        Some(Try {
            c_b: c_b.parse().ok()?,
            triangles: match triangles {
                "" => None,
                count => Some(count.parse().ok()?),
            },
        })
    };
    all.map(|text| one(text).ok_or_else(|| line.error(&format!("`{text}` among `tries` is no c_b:triangles"))))
        .collect()
}

fn report(line: &Line, cell: &Cell) -> Result<Report, TableError> {
    let c_b = line.or("tuned_c_b", cell.c_b)?;
    let (integral, integral_lfs) = (line.get("integral")?, line.get("integral_lfs")?);
    let statistics = statistics(line)?;
    let triangles = statistics.triangles as f64;
    let t_effective = line.get("t_effective")?;
    let integral_error = line.get("integral_error")?;
    let promises = Promises {
        rule: method(cell).map(|method| method.rule()).unwrap_or_default(),
        t: t_effective,
    };
    let around = [integral * (1.0 - integral_error), integral * (1.0 + integral_error)];
    Ok(Report {
        domain: stem(&cell.domain),
        mesher: cell.mesher.clone(),
        params: cell.complete(),
        spacing: cell.spacing.clone(),
        t: cell.scaled_to(c_b).t,
        t_effective,
        c_b,
        alpha: cell.t / cell.c_b,
        seed: cell.seed,
        lfs_cap: cell.lfs_cap,
        smallest_input_angle_deg: line.get("smallest_input_angle_deg")?,
        smallest_segment_angle_deg: line.get("smallest_segment_angle_deg")?,
        forced_pieces: line.or("forced_pieces", 0)?,
        integral,
        integral_error,
        integral_lfs,
        size_ratio: triangles / integral,
        size_ratio_lfs: triangles / integral_lfs,
        size_efficiency: line.get("size_efficiency")?,
        min_angle_bound_deg: promises.min_angle_deg(),
        fingerprint: line.get("fingerprint")?,
        certificate: Certificate {
            holds: line.flag("holds", true)?,
            excused: statistics.excused,
            low_head_on: line.or("low_head_on", 0)?,
            checks: checks(line, promises, c_b, around)?,
        },
        statistics,
        times: None,
        outside: line.maybe("peer_version")?.map(|version| Outside {
            version,
            ..Outside::default()
        }),
        poisson: poisson(line)?,
        poisson_failed: line.maybe("poisson_failed")?,
        rounds: Vec::new(),
        counts: line
            .family("count_", "")?
            .into_iter()
            .map(|(name, count)| (name.to_owned(), count))
            .collect(),
        provenance: None,
    })
}

/// What a domain calls itself: gallery names are names, of files the stem counts.
fn stem(domain: &str) -> String {
    let path = Path::new(domain);
    let is_file = ["poly", "geojson", "json"].iter().any(|known| {
        path.extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case(known))
    });
    let stem = path.file_stem().filter(|_| is_file);
    stem.map_or_else(|| domain.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Every claim.
fn checks(line: &Line, promises: Promises, c_b: f64, integral: [f64; 2]) -> Result<Vec<Check>, TableError> {
    let one = |claim: Claim| {
        let broken = line.or(&broken_column(claim), 0)?;
        Ok(Check {
            claim,
            lemma: claim.lemma().into(),
            applies: line.flag(&applies_column(claim), true)?,
            worst: line.maybe(&worst_column(claim))?.or(worst_default(claim)),
            bound: Some(promises.bound(claim, c_b, integral)).filter(|bound| bound.is_finite()),
            holds: broken == 0,
            broken,
            at: None,
            witnesses: Vec::new(),
        })
    };
    Claim::ALL.into_iter().map(one).collect()
}

fn statistics(line: &Line) -> Result<Statistics, TableError> {
    let min_angle_deg: f64 = line.get("min_angle_deg")?;
    let percentiles = |name: &str| {
        let of = |end: &str| line.maybe(&format!("{name}_{end}"));
        let all = (of("p05")?, of("p50")?, of("p95")?);
        Ok(match all {
            (Some(p05), Some(p50), Some(p95)) => Some(Percentiles { p05, p50, p95 }),
            _ => None,
        })
    };
    let nn = (line.maybe("nn_over_f_min")?, line.maybe("nn_over_f_max")?);
    Ok(Statistics {
        vertices: line.get("vertices")?,
        triangles: line.get("triangles")?,
        min_angle_deg,
        min_angle_free_deg: line.maybe("min_angle_free_deg")?,
        excused: line.or("excused_triangles", 0)?,
        max_angle_deg: line.get("max_angle_deg")?,
        mean_min_angle_deg: line.get("mean_min_angle_deg")?,
        p05_min_angle_deg: line.get("p05_min_angle_deg")?,
        // The shortest edge is opposite to the smallest angle: the law of sines.
        max_radius_edge: 0.5 / min_angle_deg.to_radians().sin(),
        min_angle_histogram: vec![0; BINS],
        edge_over_size: percentiles("edge_over_size")?,
        nn_over_f: nn.0.zip(nn.1).map(|(min, max)| Range { min, max }),
        beta: line.maybe("beta")?,
        seams: side(line, "met")?
            .zip(side(line, "elsewhere")?)
            .map(|(met, elsewhere)| Seams { met, elsewhere }),
    })
}

fn side(line: &Line, name: &str) -> Result<Option<Angles>, TableError> {
    let column = |what: &str| format!("{name}_{what}");
    let Some(triangles) = line.maybe(&column("triangles"))? else {
        return Ok(None);
    };
    Ok(Some(Angles {
        triangles,
        min_deg: line.get(&column("min_angle_deg"))?,
        mean_deg: line.get(&column("mean_min_angle_deg"))?,
        p05_deg: line.get(&column("p05_min_angle_deg"))?,
        share_under_30: line.get(&column("share_under_30_deg"))?,
    }))
}

fn poisson(line: &Line) -> Result<Option<Solution>, TableError> {
    let Some(unknowns) = line.maybe("poisson_unknowns")? else {
        return Ok(None);
    };
    let word = line.text("poisson_solver").unwrap_or_default();
    let solver = [Solver::Cholesky, Solver::ConjugateGradients]
        .into_iter()
        .find(|solver| solver_word(*solver) == word);
    let spectrum = match line.maybe::<f64>("poisson_largest")? {
        Some(largest) => {
            let [most, least]: [f64; 2] = [
                line.get("poisson_largest_preconditioned")?,
                line.get("poisson_smallest_preconditioned")?,
            ];
            Some(Spectrum {
                largest,
                largest_preconditioned: most,
                smallest_preconditioned: least,
                condition_preconditioned: most / least,
            })
        }
        None => None,
    };
    Ok(Some(Solution {
        unknowns,
        energy_error: line.get("poisson_energy_error")?,
        energy_norm: line.get("poisson_energy_norm")?,
        l2_error: line.get("poisson_l2_error")?,
        l2_norm: line.get("poisson_l2_norm")?,
        solver: solver.ok_or_else(|| line.error(&format!("`{word}` is no solver")))?,
        iterations: line.get("poisson_iterations")?,
        converged: line.flag("poisson_converged", true)?,
        spectrum,
    }))
}

/// The reports of some rows by key.
pub(super) struct Reports<'a>(HashMap<String, &'a mut Report>);

impl<'a> Reports<'a> {
    pub(super) fn of(rows: &'a mut [Row]) -> Self {
        let own = rows
            .iter_mut()
            .filter_map(|row| Some((row.key.clone(), row.report.as_mut()?)));
        Self(own.collect())
    }

    /// The report that a line is about.
    fn about(&mut self, line: &Line) -> Result<&mut Report, TableError> {
        let key: String = line.get("key")?;
        let found = self.0.get_mut(&key);
        found
            .map(|report| &mut **report)
            .ok_or_else(|| line.error(&format!("`meshes.csv` has no mesh `{key}`")))
    }

    pub(super) fn add_angles(&mut self, path: &Path) -> Result<(), TableError> {
        let mut histograms: HashMap<String, Vec<u64>> = HashMap::new();
        for line in Table::read(path)?.lines() {
            let counts: Result<_, TableError> = (0..BINS).map(|degree| line.or(&bin_column(degree), 0)).collect();
            histograms.insert(line.get("fingerprint")?, counts?);
        }
        for report in self.0.values_mut() {
            if let Some(counts) = histograms.get(&report.fingerprint) {
                report.statistics.min_angle_histogram = counts.clone();
            }
        }
        Ok(())
    }

    pub(super) fn add_broken(&mut self, path: &Path) -> Result<(), TableError> {
        for line in Table::read(path)?.lines() {
            let name: String = line.get("claim")?;
            let checks = &mut self.about(&line)?.certificate.checks;
            let check = checks.iter_mut().find(|check| check.claim.name() == name);
            let check = check.ok_or_else(|| line.error(&format!("`{name}` is no claim")))?;
            check.bound = line.maybe("bound")?;
            check.at = line.maybe("x")?.zip(line.maybe("y")?).map(|(x, y)| [x, y]);
        }
        Ok(())
    }

    pub(super) fn add_times(&mut self, path: &Path) -> Result<(), TableError> {
        for line in Table::read(path)?.lines() {
            let samples = line.text("samples_seconds").into_iter().flat_map(str::split_whitespace);
            let samples = samples.map(|text| text.parse().map_err(|_| line.error(&format!("`{text}` is no number"))));
            let steps = line.family(STEP, SECONDS)?;
            let times = Times {
                seconds: Seconds {
                    total: line.get("median_seconds")?,
                    steps: steps
                        .into_iter()
                        .map(|(name, seconds)| (name.to_owned(), seconds.into()))
                        .collect(),
                },
                samples: samples.collect::<Result<_, _>>()?,
                rss_before_bytes: line.get("rss_before_bytes")?,
                peak_rss_bytes: line.get("peak_rss_bytes")?,
            };
            let report = self.about(&line)?;
            report.times = Some(times);
            if let Some(outside) = &mut report.outside {
                outside.repeats_differ = line.flag("repeats_differ", false)?;
                let told = line.family(SET_UP, SECONDS)?.into_iter();
                outside.set_up_seconds = told.map(|(name, seconds)| (name.to_owned(), seconds)).collect();
            }
        }
        Ok(())
    }

    pub(super) fn add_rounds(&mut self, path: &Path) -> Result<(), TableError> {
        for line in Table::read(path)?.lines() {
            let round = Round {
                vertices: line.get("vertices")?,
                triangles: line.get("triangles")?,
                l2_error: line.get("l2_error")?,
                energy_error: line.get("energy_error")?,
                settled: line.get("settled")?,
                least_change: line.get("least_change")?,
                independent: line.get("independent")?,
                kept: line.get("kept")?,
            };
            self.about(&line)?.rounds.push(round);
        }
        Ok(())
    }
}
