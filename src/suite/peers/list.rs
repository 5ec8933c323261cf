//! Every peer there is: name of its folder under `baselines/`, what it is, its parameters.

use super::SIZE;
use crate::meshers::Parameter;

/// One peer of the list.
pub struct PeerEntry {
    /// Name on the command line and in rows, and of its folder under `baselines/`.
    pub name: &'static str,
    /// One line for `list`.
    pub summary: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
}

/// Every peer. Its README under `baselines/` says how it is run and under which licence it comes.
pub static PEERS: &[PeerEntry] = &[
    PeerEntry {
        name: "triangle",
        summary: "Triangle 1.6: Delaunay refinement with off-centres (Shewchuk 1996; Üngör 2004)",
        parameters: &[ANGLE, PASSES, SIZE],
    },
    PeerEntry {
        name: "meshpy",
        summary: "Triangle by way of MeshPy, the size function as a callback",
        parameters: &[ANGLE, SIZE],
    },
    PeerEntry {
        name: "gmsh",
        summary: "Gmsh's four 2D algorithms, the size function as a callback",
        parameters: &[Parameter {
            name: "algorithm",
            values: "frontal-delaunay, delaunay, meshadapt, bamg",
            default: "frontal-delaunay",
            help: "which of Gmsh's algorithms",
        }],
    },
    PeerEntry {
        name: "cgal",
        summary: "CGAL Mesh_2: Delaunay refinement with a criterion of its own for the size",
        parameters: &[
            Parameter {
                name: "aspect",
                values: "0.001 to 0.125",
                default: "0.125",
                help: "B, the squared sine of the smallest angle: refinement ends for sure up to 0.125, which is 20.7°",
            },
            Parameter {
                name: "lloyd",
                values: "0 to 1000",
                default: "0",
                help: "steps of Lloyd's optimisation afterwards",
            },
            SIZE,
        ],
    },
    PeerEntry {
        name: "netgen",
        summary: "Netgen: advancing front with rules, then smoothing and swaps",
        parameters: &[
            Parameter {
                name: "optimise",
                values: "0 to 20",
                default: "3",
                help: "steps of optimisation",
            },
            Parameter {
                name: "density",
                values: "0.25 to 4",
                default: "1",
                help: "points that restrict the size stand s / density apart",
            },
            Parameter {
                name: "grading",
                values: "0.01 to 1",
                default: "0.3",
                help: "how fast the size may grow away from where it is restricted",
            },
        ],
    },
    PeerEntry {
        name: "mmg",
        summary: "mmg2d: local remeshing to an isotropic metric",
        parameters: &[Parameter {
            name: "passes",
            values: "1 to 20",
            default: "5",
            help: "runs, the metric taken anew on the mesh of the one before",
        }],
    },
    PeerEntry {
        name: "pymeshlab",
        summary: "MeshLab: isotropic explicit remeshing of the flat triangulated domain",
        parameters: &[Parameter {
            name: "iterations",
            values: "1 to 100",
            default: "10",
            help: "rounds of split, collapse, flip and smooth",
        }],
    },
    PeerEntry {
        name: "bamg",
        summary: "BAMG in FreeFEM: Delaunay remeshing to an isotropic metric",
        parameters: &[Parameter {
            name: "passes",
            values: "1 to 20",
            default: "6",
            help: "calls of adaptmesh, the metric taken anew on the mesh of the one before",
        }],
    },
    PeerEntry {
        name: "spade",
        summary: "spade's own Delaunay refinement",
        parameters: &[ANGLE, SIZE],
    },
    PeerEntry {
        name: "tritet",
        summary: "Triangle from Rust by way of tritet, uniform sizes only",
        parameters: &[ANGLE, SIZE],
    },
];

const ANGLE: Parameter = Parameter {
    name: "angle",
    values: "0 to 34",
    default: "30",
    help: "smallest angle to refine for, degrees",
};

const PASSES: Parameter = Parameter {
    name: "passes",
    values: "1 to 100",
    default: "30",
    help: "most rounds of refinement for a size that varies",
};

/// Whether a mesher of that name is a peer.
pub fn is_peer(name: &str) -> bool {
    PEERS.iter().any(|entry| entry.name == name)
}

#[cfg(test)]
mod tests {
    use super::super::Peer;
    use super::*;
    use crate::meshers::{MESHERS, Parameters};

    #[test]
    fn every_peer_makes_itself_and_has_a_name_of_its_own() {
        for (place, entry) in PEERS.iter().enumerate() {
            assert!(Peer::new(entry, &Parameters::new()).is_ok(), "{}", entry.name);
            let others = MESHERS.iter().map(|mesher| mesher.name);
            let mut others = others.chain(PEERS[..place].iter().map(|peer| peer.name));
            assert!(others.all(|other| other != entry.name), "{}", entry.name);
            let folder = std::path::Path::new(super::super::install::BASELINES).join(entry.name);
            assert!(
                folder.join("README.md").is_file(),
                "{} says what it is",
                folder.display()
            );
        }
    }

    #[test]
    fn a_parameter_that_is_not_there_is_refused() {
        let refused = |name: &str, value: serde_json::Value| {
            let given = Parameters::from_iter([(name.to_owned(), value)]);
            Peer::new(&PEERS[0], &given).expect_err("refused")
        };
        assert_eq!(refused("angel", 30.into()), "there is no parameter `angel`");
        assert!(refused("size", "some".into()).contains("size"));
    }
}
