//! The findings of an experiment, quoted in another page.

use super::{ReportError, findings_in_short};
use crate::suite::files::write_whole;
use std::path::Path;

/// Ends a quotation.
const END: &str = "<!-- end of findings -->";

/// What stands before a quotation of the findings of `folder`.
fn begin(folder: &str) -> String {
    format!("<!-- findings of {folder}, made by `biting report`; do not edit -->\n")
}

/// Puts the main findings of `folder` between the two comments in `page` that ask for them, and says whether it has such.
///
/// # Errors
/// [`ReportError`]: no rows in the folder, or a page that cannot be written.
pub fn quote_findings(folder: &Path, page: &Path) -> Result<bool, ReportError> {
    let Ok(text) = std::fs::read_to_string(page) else {
        return Ok(false);
    };
    let begin = begin(&folder.display().to_string());
    let Some((before, rest)) = text.split_once(&begin) else {
        return Ok(false);
    };
    let Some((_, after)) = rest.split_once(END) else {
        return Ok(false);
    };
    let findings = findings_in_short(folder)?;
    let quoted = format!("{before}{begin}\n{findings}\n{END}{after}");
    if quoted != text {
        write_whole(page, quoted.as_bytes()).map_err(|source| ReportError::Write {
            path: page.to_path_buf(),
            source,
        })?;
    }
    Ok(true)
}
