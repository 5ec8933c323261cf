//! Domains by name or from files: Triangle's `.poly` (with `.node`) and GeoJSON.

use super::{Domain, DomainError, Pslg, gallery};
use std::path::Path;

pub mod geojson;
pub mod poly;
mod poly_write;

/// The domain that `spec` names: a gallery name, or the path of a `.poly`, `.geojson` or `.json` file.
///
/// # Errors
/// [`DomainError`], which says in one message what is wrong, where, and what to do.
pub fn load(spec: &str) -> Result<Domain, DomainError> {
    read(spec).and_then(Domain::new)
}

/// The PSLG that `spec` names, not yet validated: what [`super::repair()`] takes.
///
/// # Errors
/// [`DomainError`] if there is no such name or file, or if the file does not follow its format.
pub fn read(spec: &str) -> Result<Pslg, DomainError> {
    if let Some(pslg) = gallery::pslg(spec) {
        return pslg.map_err(|message| DomainError::Unknown {
            name: spec.to_owned(),
            message,
        });
    }
    let path = Path::new(spec);
    let ending = path
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or("")
        .to_ascii_lowercase();
    let known = matches!(ending.as_str(), "poly" | "geojson" | "json");
    if !known || !path.exists() {
        return Err(unknown(spec, &ending, path.exists()));
    }
    let text = read_text(path)?;
    let mut pslg = match ending.as_str() {
        "poly" => poly::parse(&text, spec, || read_node_beside(path)),
        _ => geojson::parse(&text, spec),
    }?;
    pslg.name = path
        .file_stem()
        .map_or_else(|| spec.to_owned(), |stem| stem.to_string_lossy().into_owned());
    Ok(pslg)
}

/// A file's text; bytes that are not UTF-8 are replaced, since they can only be in comments.
fn read_text(path: &Path) -> Result<String, DomainError> {
    let bytes = std::fs::read(path).map_err(|error| DomainError::Unreadable {
        file: path.display().to_string(),
        message: format!("cannot be read: {error}"),
    })?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn read_node_beside(path: &Path) -> Result<(String, String), DomainError> {
    let beside = path.with_extension("node");
    let text = read_text(&beside)?;
    Ok((text, beside.display().to_string()))
}

fn unknown(spec: &str, ending: &str, exists: bool) -> DomainError {
    let message = if exists {
        format!("files ending in \".{ending}\" are not read; give a .poly, .geojson or .json file")
    } else if Path::new(spec).extension().is_some() && !spec.contains(':') {
        "there is no such file".to_owned()
    } else {
        let names: Vec<&str> = gallery::ENTRIES.iter().map(|entry| entry.name).collect();
        format!(
            "no domain of that name and no such file; the gallery has {}; files end in .poly or .geojson",
            names.join(", ")
        )
    };
    DomainError::Unknown {
        name: spec.to_owned(),
        message,
    }
}
