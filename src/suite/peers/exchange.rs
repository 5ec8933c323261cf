//! The files of `baselines/PROTOCOL.md`: request, domain and field go out, mesh and answer come back.

use super::PeerRun;
use super::size_field::SizeField;
use crate::domain::Domain;
use crate::mesh;
use crate::meshers::{Parameters, Request};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Version of the protocol.
const PROTOCOL: u32 = 1;

/// What the request calls itself: the one argument of a peer's program.
pub const REQUEST: &str = "request.json";

const DOMAIN: &str = "domain.poly";
const FIELD: &str = "size.field";
const MESH: &str = "mesh";
const ANSWER: &str = "answer.json";

#[derive(Serialize)]
struct Asked<'a> {
    protocol: u32,
    domain: &'a str,
    size: Option<Size<'a>>,
    parameters: &'a Parameters,
    threads: usize,
    seed: u64,
    mesh: &'a str,
    answer: &'a str,
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase", untagged)]
enum Size<'a> {
    Uniform { uniform: f64 },
    Field { field: &'a str, scale: f64 },
}

/// What a peer reports of its run.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    version: String,
    seconds: BTreeMap<String, f64>,
    rss_before_bytes: u64,
    peak_rss_bytes: u64,
    /// Numbers that the peer reports of itself.
    #[serde(default)]
    counts: BTreeMap<String, f64>,
}

/// Why what came back cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ExchangeError {
    /// A file cannot be written or read.
    #[error("{file}: {cause}")]
    Io {
        /// Which.
        file: &'static str,
        /// What the system says.
        cause: io::Error,
    },
    /// The answer is not as the protocol says.
    #[error("{ANSWER}: {0}")]
    Answer(String),
    /// The mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] mesh::files::MeshFileError),
}

fn io_error(file: &'static str) -> impl FnOnce(io::Error) -> ExchangeError {
    move |cause| ExchangeError::Io { file, cause }
}

/// The size that a peer is asked for: c_b times this.
#[derive(Clone, Copy, Debug)]
pub enum Control<'a> {
    /// f is the same everywhere.
    Uniform(f64),
    /// f varies.
    Field(&'a SizeField),
}

/// Writes a request with its domain and, where there is a spacing f, f itself: the size is c_b f.
///
/// # Errors
/// [`ExchangeError::Io`].
pub fn write(
    folder: &Path,
    domain: &Domain,
    spacing: Option<Control>,
    request: &Request,
    parameters: &Parameters,
) -> Result<(), ExchangeError> {
    std::fs::write(folder.join(DOMAIN), domain.to_poly()).map_err(io_error(DOMAIN))?;
    let size = match spacing {
        None => None,
        Some(Control::Uniform(f)) => Some(Size::Uniform {
            uniform: request.c_b * f,
        }),
        Some(Control::Field(field)) => {
            std::fs::write(folder.join(FIELD), field.to_bytes()).map_err(io_error(FIELD))?;
            Some(Size::Field {
                field: FIELD,
                scale: request.c_b,
            })
        }
    };
    let asked = Asked {
        protocol: PROTOCOL,
        domain: DOMAIN,
        size,
        parameters,
        threads: request.threads,
        seed: request.seed,
        mesh: MESH,
        answer: ANSWER,
    };
    let text = serde_json::to_vec(&asked).map_err(|cause| io_error(REQUEST)(cause.into()))?;
    std::fs::write(folder.join(REQUEST), text).map_err(io_error(REQUEST))
}

/// Reads the answer and the mesh that came with it.
///
/// # Errors
/// [`ExchangeError`]: what is missing or not as the protocol says.
pub fn read(folder: &Path) -> Result<PeerRun, ExchangeError> {
    let text = std::fs::read(folder.join(ANSWER)).map_err(io_error(ANSWER))?;
    let answer: Answer = serde_json::from_slice(&text).map_err(|cause| ExchangeError::Answer(cause.to_string()))?;
    let mut set_up = answer.seconds;
    let seconds = set_up.remove(MESHING);
    let Some(seconds) = seconds.filter(|seconds| seconds.is_finite() && *seconds >= 0.0) else {
        return Err(ExchangeError::Answer(format!("no seconds of `{MESHING}`")));
    };
    Ok(PeerRun {
        mesh: mesh::files::read(&folder.join(format!("{MESH}.node")))?,
        version: answer.version,
        seconds,
        set_up,
        rss_before_bytes: answer.rss_before_bytes,
        peak_rss_bytes: answer.peak_rss_bytes,
        counts: answer.counts,
    })
}

/// The part of a peer's seconds that is compared.
const MESHING: &str = "mesh";
