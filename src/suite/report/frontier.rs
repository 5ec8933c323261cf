//! The part of the page on what a smallest angle costs: biting beside refinement and Triangle.

use super::drawer::Drawer;
use super::markdown::{number, table};
use crate::suite::analysis::frontier::{Family, factors, families};
use crate::suite::analysis::results::Results;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{first_seen, median, quantile};
use crate::suite::rows::record::Row;
use crate::suite::run::plan::Section;

/// Smallest angles at which sizes are compared, degrees.
const ANGLES_DEG: [f64; 6] = [10.0, 15.0, 20.0, 25.0, 28.0, 30.0];

/// The peer that biting is measured by, if it was run.
const MEASURE: &str = "triangle";

/// Families by domain, then those over all domains.
pub(super) fn by_domain(results: &Results) -> Vec<(String, Vec<Family>)> {
    let rows = results.of(Section::Frontier);
    let domains = first_seen(rows.iter().map(|row| row.cell.domain.as_str()));
    let own = |domain: &str| {
        let own: Vec<&Row> = rows.iter().copied().filter(|row| row.cell.domain == domain).collect();
        (domain.to_owned(), families(&own))
    };
    let mut all: Vec<_> = domains.iter().map(|domain| own(domain)).collect();
    if all.len() > 1 {
        all.push((ALL.to_owned(), families(&rows)));
    }
    all
}

/// What stands for all domains together.
pub(super) const ALL: &str = "all domains";

/// A mesher's smallest size at an angle, over its families, with the setting.
fn fewest<'a>(families: &'a [Family], mesher: &str, angle_deg: f64) -> Option<(&'a Family, &'a str, f64)> {
    let own = families.iter().filter(|family| family.mesher == mesher);
    let found = own.filter_map(|family| {
        let point = family.fewest(angle_deg)?;
        Some((family, point.setting.as_str(), point.size))
    });
    found.min_by(|a, b| a.2.total_cmp(&b.2))
}

/// The meshers of the experiment, ours first.
fn meshers(families: &[Family]) -> Vec<&str> {
    first_seen(families.iter().map(|family| family.mesher.as_str()))
}

/// The part of the page: a table for each angle over domains, and the settings that come nearest.
pub(super) fn text(results: &Results) -> String {
    let all = by_domain(results);
    let Some((_, whole)) = all.last() else {
        return String::new();
    };
    let meshers = meshers(whole);
    let mut text = String::from(
        "Triangles/∫dA/lfs², the fewest that a mesher has with a smallest angle of at least so much, over all its settings; in brackets \
         how many times Triangle's. Triangles at input angles under 60° are left out of the angle. Over all domains a setting counts \
         that was measured on each: its angle is the smallest of them, its size the median.\n\n",
    );
    text += &constants(results);
    for angle in ANGLES_DEG {
        let cell = |families: &[Family], mesher: &&str| match fewest(families, mesher, angle) {
            None => "–".to_owned(),
            Some((_, _, size)) => match fewest(families, MEASURE, angle) {
                Some((_, _, measure)) if *mesher != MEASURE => format!("{} ({})", number(size), number(size / measure)),
                _ => number(size),
            },
        };
        let line = |(domain, families): &(String, Vec<Family>)| {
            let setting = fewest(families, &results.about, angle);
            let setting = setting.map_or_else(
                || "–".to_owned(),
                |(family, setting, _)| format!("{}, {setting}", family.label),
            );
            let sizes = meshers.iter().map(|mesher| cell(families, mesher));
            std::iter::once(domain.clone())
                .chain(sizes)
                .chain([setting])
                .collect::<Vec<_>>()
        };
        let setting = format!("{}'s setting", results.about);
        let mut head = vec!["domain"];
        head.extend(&meshers);
        head.push(&setting);
        text += &format!(
            "### At {angle}°\n\n{}",
            table(&head, &all.iter().map(line).collect::<Vec<_>>())
        );
    }
    text + &nearest(results)
}

/// The settings of ours that have the fewest triangles for Triangle's at the same angle, by the median over domains.
fn nearest(results: &Results) -> String {
    let settings = by_factor(results);
    if settings.is_empty() {
        return String::new();
    }
    let line = |setting: &Setting| {
        vec![
            setting.name.clone(),
            setting.factors.len().to_string(),
            number(median(setting.factors.clone())),
            number(quantile(setting.factors.clone(), 0.0)),
            number(quantile(setting.factors.clone(), 1.0)),
        ]
    };
    let head = ["setting", "domains", "times Triangle's, median", "least", "most"];
    let lines: Vec<_> = settings.iter().take(MOST_SETTINGS).map(line).collect();
    "### Which setting comes nearest\n\nOn each domain the triangles of a setting over the fewest that Triangle has with at least the \
     same smallest angle; the settings with the smallest medians, of those for which Triangle reached the angle on every domain \
     where they were measured:\n\n"
        .to_owned()
        + &table(&head, &lines)
}

const MOST_SETTINGS: usize = 12;

/// A setting of ours with its factors to the measure, one for each domain.
struct Setting {
    name: String,
    factors: Vec<f64>,
}

/// The settings of ours by the median of their factors; those measured on fewer domains than the most are left out.
fn by_factor(results: &Results) -> Vec<Setting> {
    let domains = by_domain(results);
    let mut settings: Vec<Setting> = Vec::new();
    for (_, families) in domains.iter().filter(|(domain, _)| domain != ALL) {
        let Some(measure) = families.iter().find(|family| family.mesher == MEASURE) else {
            continue;
        };
        for own in families.iter().filter(|family| family.mesher == results.about) {
            for (setting, factor) in factors(own, measure) {
                let name = format!("{}, {setting}", own.label);
                match settings.iter_mut().find(|known| known.name == name) {
                    Some(known) => known.factors.push(factor),
                    None => settings.push(Setting {
                        name,
                        factors: vec![factor],
                    }),
                }
            }
        }
    }
    let most = settings.iter().map(|setting| setting.factors.len()).max().unwrap_or(0);
    settings.retain(|setting| setting.factors.len() == most);
    settings.sort_by(|a, b| {
        let middle = |setting: &Setting| median(setting.factors.clone()).unwrap_or(f64::INFINITY);
        middle(a).total_cmp(&middle(b))
    });
    settings
}

/// How many times the triangles of the measure ours has at an angle: a factor for each domain where both reach it, the least first.
fn over_measure(results: &Results, angle: f64) -> Vec<(f64, String)> {
    let of = |(domain, families): (String, Vec<Family>)| {
        let own = fewest(&families, &results.about, angle)?.2;
        Some((own / fewest(&families, MEASURE, angle)?.2, domain))
    };
    let domains = by_domain(results).into_iter().filter(|(domain, _)| domain != ALL);
    let mut factors: Vec<(f64, String)> = domains.filter_map(of).collect();
    factors.sort_by(|a, b| a.0.total_cmp(&b.0));
    factors
}

/// The angle that the first finding names, degrees.
const TOLD_DEG: f64 = 20.0;

/// How far ours is from the measure, and which setting comes nearest.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let middle = |factors: Vec<f64>| median(factors).map(number);
    let factors = over_measure(results, TOLD_DEG);
    let count = factors.len();
    let constant = middle(factors.into_iter().map(|(factor, _)| factor).collect()).map(|times| {
        format!(
            "For a smallest angle of {TOLD_DEG}°, {} needs {times} times as many triangles as Triangle does, in the median over {count} domains.",
            results.about
        )
    });
    let nearest = by_factor(results).into_iter().next().and_then(|setting| {
        let times = middle(setting.factors)?;
        Some(format!(
            "The setting that comes nearest to Triangle on all domains is {}, with {times} times its triangles.",
            setting.name
        ))
    });
    constant.into_iter().chain(nearest).collect()
}

/// The factor at each angle, over the domains.
fn constants(results: &Results) -> String {
    let line = |angle: f64| {
        let factors = over_measure(results, angle);
        let end = |factor: Option<&(f64, String)>| {
            factor.map_or("–".into(), |(factor, domain)| {
                format!("{} ({domain})", number(*factor))
            })
        };
        vec![
            format!("{angle}°"),
            factors.len().to_string(),
            number(median(factors.iter().map(|(factor, _)| *factor).collect())),
            end(factors.first()),
            end(factors.last()),
        ]
    };
    let head = ["smallest angle", "domains", "times Triangle's, median", "least", "most"];
    format!(
        "The fewest triangles of {} over the fewest of Triangle:\n\n",
        results.about
    ) + &table(&head, &ANGLES_DEG.map(line))
}

/// What a smallest angle costs, over all domains and on each.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    for (domain, families) in by_domain(results).iter().rev() {
        let name = format!("frontier-{}", domain.replace(' ', "-"));
        let caption = match domain.as_str() {
            ALL => "Smallest of the angles and median of the sizes over all domains.".to_owned(),
            _ => format!("Size against smallest angle on {domain}."),
        };
        charts::frontier(domain, families, &drawer.chart(&name, &caption))?;
    }
    Ok(())
}
