//! `tally.csv`, `cases.csv` and `tally_times.csv`: what cases came to that are tallied.

use super::column::{Column, Line, Table, TableError, number};
use super::{CASES, TALLY, TALLY_TIMES};
use crate::suite::rows::tally::{Family, Tally, Uncertified, Verdict};
use std::path::Path;

/// A method of a family; of a family that was skipped no method.
pub(super) struct Count<'a> {
    family: &'a Family,
    tally: Option<&'a Tally>,
}

/// The lines of `tally.csv` and `tally_times.csv`.
pub(super) fn counts(families: &[Family]) -> Vec<Count<'_>> {
    let lines = families.iter().flat_map(|family| {
        let skipped = family.tallies.is_empty().then_some(None);
        let tallies = skipped.into_iter().chain(family.tallies.iter().map(Some));
        tallies.map(move |tally| Count { family, tally })
    });
    lines.collect()
}

fn family<'a>() -> Column<Count<'a>> {
    let about = "the family of domains, as the plan names it";
    Column::new("family", about, |count: &Count| Some(count.family.name.clone()))
}

fn method<'a>() -> Column<Count<'a>> {
    let about = "mesher and parameters; nothing where the family was skipped";
    Column::new("method", about, |count: &Count| Some(count.tally?.method.clone()))
}

/// The columns of `tally.csv`.
pub(super) fn columns<'a>() -> Vec<Column<Count<'a>>> {
    let verdict = |verdict: Verdict| {
        let about = format!("cases that ended so: {}", meaning(verdict));
        Column::new(&verdict.to_string(), &about, move |count: &Count| {
            Some(count.tally?.count(verdict).to_string())
        })
        .or("0")
    };
    let mut columns = vec![family(), method()];
    columns.extend(Verdict::ALL.map(verdict));
    columns.extend([
        Column::new("triangles", "triangles of all meshes", |count: &Count| {
            Some(count.tally?.triangles.to_string())
        }),
        Column::new(
            "discarded",
            "of the family: random domains thrown away since they were no valid PSLG",
            |count: &Count| Some(count.family.discarded.to_string()),
        )
        .or("0"),
        Column::new(
            "digest",
            "of the family: a hash of the meshes of all methods, equal on every run",
            |count: &Count| Some(count.family.digest.clone()),
        ),
        Column::new(
            "skipped",
            "why the family was not run, where it was not",
            |count: &Count| count.family.skipped.clone(),
        ),
    ]);
    columns
}

fn meaning(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Certified => "every guaranteed check of the mesh's certificate holds",
        Verdict::Declined => "a typed error says why there is no mesh, though the domain is valid",
        Verdict::Stopped => "a budget ended it, or was going to",
        Verdict::Refused => "the domain is no valid PSLG",
        Verdict::Panicked => "it panicked, or ended its process",
        Verdict::Hung => "it was not done long after its budget",
        Verdict::Invalid => "a guaranteed check of the certificate fails",
    }
}

/// The columns of `tally_times.csv`.
pub(super) fn times<'a>() -> Vec<Column<Count<'a>>> {
    let about = "seconds of all cases, from the domain's name to the verdict";
    let seconds = Column::new("seconds", about, |count: &Count| Some(number(count.tally?.seconds)));
    vec![family(), method(), seconds]
}

/// A case that is not certified, of a family.
pub(super) type Case<'a> = (&'a str, &'a Uncertified);

/// The lines of `cases.csv`.
pub(super) fn cases(families: &[Family]) -> Vec<Case<'_>> {
    let lines = families
        .iter()
        .flat_map(|family| family.uncertified.iter().map(|case| (family.name.as_str(), case)));
    lines.collect()
}

/// The columns of `cases.csv`.
pub(super) fn case_columns<'a>() -> Vec<Column<Case<'a>>> {
    vec![
        Column::new("family", "the family of domains", |case: &Case| Some(case.0.to_owned())),
        Column::new("method", "mesher and parameters", |case: &Case| {
            Some(case.1.method.clone())
        }),
        Column::new("verdict", "how it ended, as a column of `tally.csv`", |case: &Case| {
            Some(case.1.verdict.to_string())
        }),
        Column::new("domain", "gallery name or file", |case: &Case| {
            Some(case.1.domain.clone())
        }),
        Column::new("reason", "why it is not certified", |case: &Case| {
            Some(case.1.reason.clone())
        }),
        Column::new("command", "what runs it again", |case: &Case| {
            Some(case.1.command.clone())
        }),
    ]
}

/// The families of a folder's tables.
pub(super) fn read(folder: &Path) -> Result<Vec<Family>, TableError> {
    let mut families: Vec<Family> = Vec::new();
    for line in Table::read(&folder.join(TALLY))?.lines() {
        let name: String = line.get("family")?;
        if families.last().is_none_or(|family| family.name != name) {
            families.push(Family {
                name,
                skipped: line.maybe("skipped")?,
                discarded: line.or("discarded", 0)?,
                digest: line.or("digest", String::new())?,
                ..Family::default()
            });
        }
        let tally = tally(&line)?;
        families
            .iter_mut()
            .last()
            .into_iter()
            .for_each(|family| family.tallies.extend(tally.clone()));
    }
    for line in Table::read(&folder.join(TALLY_TIMES))?.lines() {
        let (name, method) = (line.text("family"), line.text("method"));
        let family = families.iter_mut().find(|family| name == Some(&family.name));
        let tally = family.and_then(|family| family.tallies.iter_mut().find(|tally| method == Some(&tally.method)));
        if let Some(tally) = tally {
            tally.seconds = line.get("seconds")?;
        }
    }
    for line in Table::read(&folder.join(CASES))?.lines() {
        let name = line.text("family");
        let family = families.iter_mut().find(|family| name == Some(&family.name));
        let case = Uncertified {
            method: line.get("method")?,
            verdict: verdict(&line)?,
            domain: line.get("domain")?,
            reason: line.or("reason", String::new())?,
            command: line.get("command")?,
        };
        let family = family.ok_or_else(|| line.error("a family that is not in `tally.csv`"))?;
        family.uncertified.push(case);
    }
    Ok(families)
}

fn tally(line: &Line) -> Result<Option<Tally>, TableError> {
    let Some(method) = line.maybe("method")? else {
        return Ok(None);
    };
    let mut tally = Tally {
        method,
        triangles: line.or("triangles", 0)?,
        ..Tally::default()
    };
    for verdict in Verdict::ALL {
        let count = line.or(&verdict.to_string(), 0)?;
        if count > 0 {
            tally.cases.insert(verdict, count);
        }
    }
    Ok(Some(tally))
}

fn verdict(line: &Line) -> Result<Verdict, TableError> {
    let word: String = line.get("verdict")?;
    let found = Verdict::ALL.into_iter().find(|verdict| verdict.to_string() == word);
    found.ok_or_else(|| line.error(&format!("`{word}` is no verdict")))
}

#[cfg(test)]
mod tests {
    use super::super::column::write;
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn what_is_written_of_cases_is_read() {
        let case = Uncertified {
            method: "biting".into(),
            verdict: Verdict::Declined,
            domain: "fan:seed=1".into(),
            reason: "too small, \"by far\"".into(),
            command: "biting mesh fan:seed=1".into(),
        };
        let run = Family {
            name: "fan".into(),
            discarded: 3,
            digest: "00ff".into(),
            tallies: vec![Tally {
                method: "biting".into(),
                cases: BTreeMap::from([(Verdict::Certified, 7), (Verdict::Declined, 1)]),
                triangles: 99,
                seconds: 1.5,
            }],
            uncertified: vec![case],
            ..Family::default()
        };
        let skipped = Family {
            name: "land".into(),
            skipped: Some("not there".into()),
            ..Family::default()
        };
        let families = [run, skipped];
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
        put(TALLY, write(&columns(), &counts(&families)));
        put(TALLY_TIMES, write(&times(), &counts(&families)));
        put(CASES, write(&case_columns(), &cases(&families)));
        assert_eq!(read(folder.path()).unwrap(), families);
        put(
            CASES,
            "family,method,verdict,domain,command\nfan,biting,eaten,a,b\n".into(),
        );
        let refused = read(folder.path()).unwrap_err().to_string();
        assert!(refused.contains("cases.csv:2: `eaten` is no verdict"), "{refused}");
    }
}
