//! Peers: meshers of others that people use, behind a process boundary. The list [`PEERS`], and how one is run.
//!
//! Processes, their groups and their memory are those of Unix; only Linux reports memory.
//!
//! A peer is not a [`Mesher`](crate::meshers::Mesher): it runs elsewhere and reports its own times. [`AnyMesher`] is a mesher of
//! ours or a peer, to whoever runs both. What passes between a peer and this crate, and what a folder under `baselines/` must
//! hold, is in `baselines/PROTOCOL.md`: [`exchange`] writes and reads the files, [`size_field`] is the size function in one of
//! them, [`process`] starts the program and ends it at its limits, [`install`] knows which are there.

mod any;
pub mod exchange;
pub mod install;
mod list;
pub mod process;
pub mod size_field;

pub use any::{AnyEntry, AnyMesher, RunError};
pub use list::{PEERS, PeerEntry, is_peer};

use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::meshers::{NOT_GEODESIC, Parameter, Parameters, Request, complete};
use crate::spacing::Spacing;
use exchange::Control;
use size_field::SizeField;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;
use std::time::Duration;

/// Parameter of the peers that can do without a size: whether they get one.
pub const SIZE: Parameter = Parameter {
    name: "size",
    values: "spacing, none",
    default: "spacing",
    help: "ask for edges of c_b f, or for no size, so that angles alone decide",
};

/// The largest share by which the size function that peers get differs from the one ours get, at the points where the two are
/// compared.
pub const FIELD_ERROR: f64 = 0.01;

/// Seconds that a peer may take besides those for meshing: interpreter, imports, files.
const SET_UP: Duration = Duration::from_secs(60);

/// Memory that a peer's process group may take if the request has no limit, bytes.
const MEMORY: u64 = 8_000_000_000;

/// A peer with its parameters.
#[derive(Clone, Debug)]
pub struct Peer {
    name: &'static str,
    /// All of them.
    parameters: Parameters,
}

impl Peer {
    /// The peer of that entry with the parameters given, the rest at their defaults.
    ///
    /// # Errors
    /// A parameter that the entry does not have, or a size that is neither of [`SIZE`]'s.
    fn new(entry: &PeerEntry, given: &Parameters) -> Result<Self, String> {
        let known = |name: &str| entry.parameters.iter().any(|parameter| parameter.name == name);
        if let Some(unknown) = given.keys().find(|name| !known(name)) {
            return Err(format!("there is no parameter `{unknown}`"));
        }
        let parameters = complete(entry.parameters, given);
        match parameters.get(SIZE.name).map(|value| value.as_str()) {
            None | Some(Some("spacing" | "none")) => {}
            _ => return Err(format!("{} must be one of {}", SIZE.name, SIZE.values)),
        }
        Ok(Self {
            name: entry.name,
            parameters,
        })
    }

    fn has_size(&self) -> bool {
        self.parameters
            .get(SIZE.name)
            .is_none_or(|value| value.as_str() != Some("none"))
    }

    /// Meshes `domain` with edges of about c_b f in a process of the peer's. `field` keeps f as peers get it for the next run
    /// on the same domain and spacing.
    ///
    /// # Errors
    /// [`PeerError`].
    pub fn run(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        field: &OnceLock<SizeField>,
    ) -> Result<PeerRun, PeerError> {
        if spacing.is_geodesic() {
            return Err(PeerError::Declined(NOT_GEODESIC.into()));
        }
        let folder = tempfile::Builder::new().prefix("biting-peer-").tempdir();
        let folder = folder.map_err(failed)?;
        let control = self.has_size().then(|| match spacing.lipschitz() {
            0.0 => Control::Uniform(spacing.at(domain.bounds().centre())),
            _ => Control::Field(field.get_or_init(|| SizeField::of(spacing, domain, FIELD_ERROR))),
        });
        self.run_in(folder.path(), domain, control, request)
    }

    fn run_in(
        &self,
        folder: &Path,
        domain: &Domain,
        control: Option<Control>,
        request: &Request,
    ) -> Result<PeerRun, PeerError> {
        let command = install::command(self.name).map_err(PeerError::Missing)?;
        exchange::write(folder, domain, control, request, &self.parameters).map_err(failed)?;
        let limits = process::Limits {
            time: Duration::from_secs_f64(request.budget.max_seconds.unwrap_or(3600.0)) + SET_UP,
            bytes: request.budget.max_memory.unwrap_or(MEMORY),
        };
        match process::run(&command, folder, request.threads, limits).map_err(failed)? {
            process::Ending::Done => exchange::read(folder).map_err(failed),
            process::Ending::Declined(reason) => Err(PeerError::Declined(reason)),
            process::Ending::Failed(reason) => Err(PeerError::Failed(reason)),
            process::Ending::Stopped(limit) => Err(PeerError::Failed(format!("{limit}; its processes were ended"))),
        }
    }
}

/// The mesh of a peer, and what the peer reports of its run.
#[derive(Clone, Debug, PartialEq)]
pub struct PeerRun {
    /// The mesh.
    pub mesh: Mesh,
    /// Of the program or library that made it.
    pub version: String,
    /// From domain and size function in its memory to the mesh in its memory.
    pub seconds: f64,
    /// Seconds of what came before, by name: imports, reading, setting up the size function.
    pub set_up: BTreeMap<String, f64>,
    /// Resident memory just before meshing.
    pub rss_before_bytes: u64,
    /// Peak resident memory of the process.
    pub peak_rss_bytes: u64,
    /// Numbers it reports of itself.
    pub counts: BTreeMap<String, f64>,
}

/// Why a peer made no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PeerError {
    /// It is not installed, and how to install it.
    #[error("{0}")]
    Missing(String),
    /// It cannot take this input, and why.
    #[error("declined: {0}")]
    Declined(String),
    /// It failed or was ended, and the last it said.
    #[error("{0}")]
    Failed(String),
}

fn failed(cause: impl std::fmt::Display) -> PeerError {
    PeerError::Failed(cause.to_string())
}
