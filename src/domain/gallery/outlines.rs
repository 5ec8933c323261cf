//! Real outlines from Natural Earth. `outlines/make.py` made the files and says from what, how, and under which licence.

use crate::domain::Pslg;
use crate::domain::files::poly;

/// Reads an outline's file; it holds its vertices itself.
pub(super) fn read(name: &str, text: &str) -> Result<Pslg, String> {
    let none_beside = || Ok((String::new(), name.to_owned()));
    poly::parse(text, name, none_beside).map_err(|error| error.to_string())
}
