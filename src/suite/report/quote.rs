//! What another page quotes of an experiment's results: its headline, or a table of meshers side by side.
//!
//! A page asks for it by a comment; what follows, up to the comment that ends it, is replaced:
//!
//! ```text
//! <!-- headline of results/sweep, made by `biting report`; do not edit -->
//! <!-- end of headline -->
//! <!-- standings of biting, triangle, gmsh in results/compare, made by `biting report`; do not edit -->
//! <!-- end of standings -->
//! ```

use super::{ReportError, read, standings::standings};
use crate::suite::files::write_whole;
use std::path::Path;

const BEGIN: &str = "<!-- ";
const MADE: &str = ", made by `biting report`; do not edit -->\n";

/// Puts into `page` what it asks of the results in `folder`, and returns whether it asks for something of them.
///
/// # Errors
/// [`ReportError`]: results that cannot be read, or a page that cannot be written.
pub fn quote(folder: &Path, page: &Path) -> Result<bool, ReportError> {
    let Ok(text) = std::fs::read_to_string(page) else {
        return Ok(false);
    };
    let name = folder.display().to_string();
    let (mut quoted, mut rest, mut is_asked) = (String::new(), text.as_str(), false);
    while let Some(asked) = Asked::next(rest) {
        let made = answer(&asked, folder, &name)?;
        is_asked |= made.is_some();
        quoted += asked.before;
        quoted += made.as_deref().unwrap_or(asked.there);
        rest = asked.after;
    }
    quoted += rest;
    if quoted != text {
        write_whole(page, quoted.as_bytes()).map_err(|source| ReportError::Write {
            path: page.to_path_buf(),
            source,
        })?;
    }
    Ok(is_asked)
}

/// What a page asks for, and what stands there.
struct Asked<'a> {
    /// All up to the end of the first comment.
    before: &'a str,
    /// `headline` or `standings`.
    kind: &'a str,
    /// Of what.
    of: &'a str,
    there: &'a str,
    /// From the last comment on.
    after: &'a str,
}

impl<'a> Asked<'a> {
    /// The next that a text has.
    fn next(text: &'a str) -> Option<Self> {
        let at = text.find(MADE)?;
        let start = text[..at].rfind(BEGIN)? + BEGIN.len();
        let (kind, of) = text[start..at].split_once(" of ")?;
        let (before, rest) = text.split_at(at + MADE.len());
        let (there, after) = rest.split_at(rest.find(&format!("{BEGIN}end of {kind} -->"))?);
        Some(Self {
            before,
            kind,
            of,
            there,
            after,
        })
    }
}

/// What is to stand there, if it is asked of this folder.
fn answer(asked: &Asked, folder: &Path, name: &str) -> Result<Option<String>, ReportError> {
    let meshers = asked.of.strip_suffix(name).and_then(|of| of.strip_suffix(" in "));
    Ok(match (asked.kind, meshers) {
        ("headline", _) if asked.of == name => {
            let link = name.rsplit('/').next().unwrap_or(name);
            let of = |sentence: &String| format!("* {sentence} [{link}]({name}/README.md)\n");
            Some(super::headline(folder)?.iter().map(of).collect())
        }
        ("standings", Some(meshers)) => {
            let meshers: Vec<&str> = meshers.split(", ").collect();
            Some(standings(&read(folder)?, &meshers) + "\n")
        }
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_is_searched_for_what_it_asks() {
        let page = "<!-- none -->\na\n<!-- headline of results/b, made by `biting report`; do not edit -->\nold\n<!-- end of headline -->\nc\n";
        let asked = Asked::next(page).expect("asked");
        assert_eq!((asked.kind, asked.of, asked.there), ("headline", "results/b", "old\n"));
        assert_eq!(format!("{}{}{}", asked.before, asked.there, asked.after), page);
        assert!(Asked::next(asked.after).is_none());
    }
}
