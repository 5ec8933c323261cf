//! The files of `baselines/PROTOCOL.md`: request, domain and field go out, mesh and answer come back.

use crate::domain::Domain;
use crate::mesh::{self, Mesh};
use crate::meshers::{Outside, Parameters, Request};
use crate::spacing::Background;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::Arc;

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

/// What a peer tells of its run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
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
#[derive(Clone, Debug)]
pub enum Control {
    /// f is the same everywhere.
    Uniform(f64),
    /// f on a background mesh.
    Field(Arc<Background>),
}

/// Writes a request with its domain and, where there is a spacing f, f itself: the size is c_b f.
///
/// # Errors
/// [`ExchangeError::Io`].
pub fn write(
    folder: &Path,
    domain: &Domain,
    spacing: Option<&Control>,
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
pub fn read(folder: &Path) -> Result<(Mesh, Answer), ExchangeError> {
    let text = std::fs::read(folder.join(ANSWER)).map_err(io_error(ANSWER))?;
    let answer: Answer = serde_json::from_slice(&text).map_err(|cause| ExchangeError::Answer(cause.to_string()))?;
    if !answer
        .seconds
        .get(MESHING)
        .is_some_and(|seconds| seconds.is_finite() && *seconds >= 0.0)
    {
        return Err(ExchangeError::Answer(format!("no seconds of `{MESHING}`")));
    }
    Ok((mesh::files::read(&folder.join(format!("{MESH}.node")))?, answer))
}

/// The part of a peer's seconds that is compared.
const MESHING: &str = "mesh";

impl From<Answer> for Outside {
    fn from(answer: Answer) -> Self {
        let mut set_up = answer.seconds;
        let seconds = set_up.remove(MESHING).unwrap_or_default();
        Self {
            version: answer.version,
            seconds,
            set_up,
            rss_before_bytes: answer.rss_before_bytes,
            peak_rss_bytes: answer.peak_rss_bytes,
            counts: answer.counts,
        }
    }
}
