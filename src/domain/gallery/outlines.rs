//! Real outlines from Natural Earth. `outlines/make.py` made the files; it says from which data, how, and under which licence.

use crate::domain::Pslg;
use crate::domain::files::poly;

pub(super) const AEGEAN: &str = include_str!("outlines/aegean.poly");
pub(super) const BRITISH_ISLES: &str = include_str!("outlines/british-isles.poly");
pub(super) const ICELAND: &str = include_str!("outlines/iceland.poly");
pub(super) const ITALY: &str = include_str!("outlines/italy.poly");
pub(super) const NORWAY: &str = include_str!("outlines/norway.poly");

/// Reads an outline's file, which contains its vertices.
pub(super) fn read(name: &str, text: &str) -> Result<Pslg, String> {
    let none_beside = || Ok((String::new(), name.to_owned()));
    poly::parse(text, name, none_beside).map_err(|error| error.to_string())
}
