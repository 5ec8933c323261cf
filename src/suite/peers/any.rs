//! A mesher of ours or a peer: plans, rows and the command line name either.

use super::size_field::SizeField;
use super::{PEERS, Peer, PeerEntry, PeerError};
use crate::case::Case;
use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::meshers::{self, MESHERS, MeshError, Mesher, Parameter, Parameters, Request, Trace, complete};
use crate::quality::{Certificate, Statistics};
use crate::spacing::Spacing;
use crate::theory::Rule;
use std::sync::OnceLock;

/// An entry of [`MESHERS`] or of [`PEERS`].
#[derive(Clone, Copy)]
pub enum AnyEntry {
    /// A mesher of ours.
    Ours(&'static meshers::Entry),
    /// A peer.
    Peer(&'static PeerEntry),
}

impl AnyEntry {
    /// All of ours, and behind them all peers.
    pub fn all() -> impl Iterator<Item = Self> {
        let ours = MESHERS.iter().map(Self::Ours);
        ours.chain(PEERS.iter().map(Self::Peer))
    }

    /// The one called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::all().find(|entry| entry.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ours(entry) => entry.name,
            Self::Peer(entry) => entry.name,
        }
    }

    /// One line about it.
    pub fn summary(self) -> &'static str {
        match self {
            Self::Ours(entry) => entry.summary,
            Self::Peer(entry) => entry.summary,
        }
    }

    /// Its parameters.
    pub fn parameters(self) -> &'static [Parameter] {
        match self {
            Self::Ours(entry) => entry.parameters,
            Self::Peer(entry) => entry.parameters,
        }
    }

    /// All parameters: those given, and the defaults of the rest.
    pub fn complete(self, given: &Parameters) -> Parameters {
        complete(self.parameters(), given)
    }

    /// The mesher with the given parameters, the rest at their defaults.
    ///
    /// # Errors
    /// Which parameter is wrong.
    pub fn make(self, given: &Parameters) -> Result<AnyMesher, String> {
        match self {
            Self::Ours(entry) => (entry.make)(given).map(AnyMesher::Ours),
            Self::Peer(entry) => Peer::new(entry, given).map(AnyMesher::Peer),
        }
    }
}

/// A mesher with its parameters.
pub enum AnyMesher {
    /// One of ours.
    Ours(Box<dyn Mesher>),
    /// A peer.
    Peer(Peer),
}

/// Why neither made a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// One of ours says so.
    #[error(transparent)]
    Ours(#[from] MeshError),
    /// A peer says so.
    #[error(transparent)]
    Peer(#[from] PeerError),
}

impl RunError {
    /// Whether a budget ran out.
    pub fn is_budget(&self) -> bool {
        matches!(self, Self::Ours(MeshError::Budget { .. }))
    }

    /// Whether the mesher cannot take this input.
    pub fn is_declined(&self) -> bool {
        matches!(
            self,
            Self::Ours(MeshError::Declined(_)) | Self::Peer(PeerError::Declined(_))
        )
    }
}

impl AnyMesher {
    /// Whose spacing sets the distance of two points.
    pub fn rule(&self) -> Rule {
        match self {
            Self::Ours(mesher) => mesher.rule(),
            Self::Peer(_) => Rule::Earlier,
        }
    }

    /// The mesh, without what a peer reports of its run.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn mesh(&self, domain: &Domain, spacing: &dyn Spacing, request: &Request) -> Result<Mesh, RunError> {
        match self {
            Self::Ours(mesher) => Ok(mesher.mesh(domain, spacing, request, &mut Trace::default())?),
            Self::Peer(peer) => {
                let field = OnceLock::<SizeField>::new();
                Ok(peer.run(domain, spacing, request, &field)?.mesh)
            }
        }
    }

    /// Judges a mesh that it made by what it guarantees: a peer guarantees the structure alone.
    pub fn judge(&self, case: &Case, mesh: &Mesh) -> (Statistics, Certificate) {
        match self {
            Self::Ours(mesher) => case.judge_of(mesh, &**mesher),
            Self::Peer(_) => case.judge(mesh),
        }
    }
}
