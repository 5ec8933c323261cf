//! Meshers outside this crate, behind a process boundary: the list [`PEERS`], and how one is run.
//!
//! Processes, their groups and their memory are those of Unix; memory is told by Linux alone.
//!
//! A peer is a [`Mesher`] like any other to whoever runs it, and its mesh is judged like any other. What passes between it
//! and this crate, and what a folder under `baselines/` must hold, is in `baselines/PROTOCOL.md`: [`exchange`] writes and
//! reads the files, [`process`] starts the program and ends it at its limits, [`install`] knows which are there.

pub mod exchange;
pub mod install;
mod list;
pub mod process;

pub use list::PEERS;

use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::meshers::{self, Entry, MeshError, Mesher, Parameter, Parameters, Request, Trace};
use crate::spacing::{Background, Spacing};
use exchange::Control;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Parameter of the peers that can do without a size: whether they get one.
pub const SIZE: Parameter = Parameter {
    name: "size",
    values: "spacing, none",
    default: "spacing",
    help: "ask for edges of c_b f, or for no size, so that angles alone decide",
};

/// The largest share by which the size function that peers get differs from the one ours get, at the points where the
/// background mesh is held against it.
pub const FIELD_ERROR: f64 = 0.01;

/// What a peer may take beside the seconds it may mesh: interpreter, imports, files.
const SET_UP: Duration = Duration::from_secs(60);

/// Memory of a peer's process group where the request has no limit, bytes.
const MEMORY: u64 = 8_000_000_000;

/// The mesher called `name`: one of ours, or a peer.
pub fn find(name: &str) -> Option<&'static Entry> {
    meshers::find(name).or_else(|| PEERS.iter().find(|entry| entry.name == name))
}

/// Whether `name` is a peer's.
pub fn is_peer(name: &str) -> bool {
    PEERS.iter().any(|entry| entry.name == name)
}

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
    fn new(entry: &Entry, given: &Parameters) -> Result<Self, String> {
        let known = |name: &str| entry.parameters.iter().any(|parameter| parameter.name == name);
        if let Some(unknown) = given.keys().find(|name| !known(name)) {
            return Err(format!("there is no parameter `{unknown}`"));
        }
        let parameters = entry.complete(given);
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

    fn run(
        &self,
        folder: &Path,
        domain: &Domain,
        spacing: Option<&Control>,
        request: &Request,
    ) -> Result<(Mesh, exchange::Answer), MeshError> {
        let command = install::command(self.name).map_err(MeshError::Missing)?;
        exchange::write(folder, domain, spacing, request, &self.parameters).map_err(failed)?;
        let limits = process::Limits {
            time: Duration::from_secs_f64(request.budget.max_seconds.unwrap_or(3600.0)) + SET_UP,
            bytes: request.budget.max_memory.unwrap_or(MEMORY),
        };
        match process::run(&command, folder, request.threads, limits).map_err(failed)? {
            process::Ending::Done => exchange::read(folder).map_err(failed),
            process::Ending::Declined(reason) => Err(MeshError::Declined(reason)),
            process::Ending::Failed(reason) => Err(MeshError::Outside(reason)),
            process::Ending::Stopped(limit) => Err(MeshError::Outside(format!("{limit}; its processes were ended"))),
        }
    }
}

/// A spacing as peers get it, on the background mesh of an earlier run where there is one.
fn control(domain: &Domain, spacing: &dyn Spacing, trace: &mut Trace) -> Control {
    if spacing.lipschitz() == 0.0 {
        return Control::Uniform(spacing.at(domain.bounds().centre()));
    }
    let sample = || Arc::new(Background::of(spacing, domain, FIELD_ERROR));
    Control::Field(trace.background.get_or_insert_with(sample).clone())
}

fn failed(cause: impl std::fmt::Display) -> MeshError {
    MeshError::Outside(cause.to_string())
}

impl Mesher for Peer {
    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError> {
        crate::meshers::refuse_geodesic(spacing)?;
        let folder = tempfile::Builder::new()
            .prefix("biting-peer-")
            .tempdir()
            .map_err(failed)?;
        let control = self.has_size().then(|| control(domain, spacing, trace));
        let (mesh, answer) = self.run(folder.path(), domain, control.as_ref(), request)?;
        trace.outside = Some(answer.into());
        Ok(mesh)
    }
}
