//! Every peer there is: name of its folder under `baselines/`, what it is, its parameters.

use super::{Peer, SIZE};
use crate::meshers::{Entry, Mesher, Parameter, Parameters, find_in};

/// Every peer. Its README under `baselines/` says how it is run and under which licence it comes.
pub static PEERS: &[Entry] = &[
    Entry {
        name: "triangle",
        summary: "Triangle 1.6: Delaunay refinement with off-centres (Shewchuk 1996; Üngör 2004)",
        parameters: &[ANGLE, PASSES, SIZE],
        make: |given| peer("triangle", given),
    },
    Entry {
        name: "meshpy",
        summary: "Triangle by way of MeshPy, the size function as a callback",
        parameters: &[ANGLE, SIZE],
        make: |given| peer("meshpy", given),
    },
    Entry {
        name: "gmsh",
        summary: "Gmsh's four 2D algorithms, the size function as a callback",
        parameters: &[Parameter {
            name: "algorithm",
            values: "frontal-delaunay, delaunay, meshadapt, bamg",
            default: "frontal-delaunay",
            help: "which of Gmsh's algorithms",
        }],
        make: |given| peer("gmsh", given),
    },
    Entry {
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
        make: |given| peer("cgal", given),
    },
    Entry {
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
        make: |given| peer("netgen", given),
    },
    Entry {
        name: "mmg",
        summary: "mmg2d: local remeshing to an isotropic metric",
        parameters: &[Parameter {
            name: "passes",
            values: "1 to 20",
            default: "5",
            help: "runs, the metric taken anew on the mesh of the one before",
        }],
        make: |given| peer("mmg", given),
    },
    Entry {
        name: "pymeshlab",
        summary: "MeshLab: isotropic explicit remeshing of the flat triangulated domain",
        parameters: &[Parameter {
            name: "iterations",
            values: "1 to 100",
            default: "10",
            help: "rounds of split, collapse, flip and smooth",
        }],
        make: |given| peer("pymeshlab", given),
    },
    Entry {
        name: "bamg",
        summary: "BAMG in FreeFEM: Delaunay remeshing to an isotropic metric",
        parameters: &[Parameter {
            name: "passes",
            values: "1 to 20",
            default: "6",
            help: "calls of adaptmesh, the metric taken anew on the mesh of the one before",
        }],
        make: |given| peer("bamg", given),
    },
    Entry {
        name: "spade",
        summary: "spade's own Delaunay refinement",
        parameters: &[ANGLE, SIZE],
        make: |given| peer("spade", given),
    },
    Entry {
        name: "tritet",
        summary: "Triangle from Rust by way of tritet, uniform sizes only",
        parameters: &[ANGLE, SIZE],
        make: |given| peer("tritet", given),
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

fn peer(name: &str, given: &Parameters) -> Result<Box<dyn Mesher>, String> {
    let entry = find_in(PEERS, name).ok_or_else(|| format!("there is no peer `{name}`"))?;
    Ok(Box::new(Peer::new(entry, given)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshers::MESHERS;

    #[test]
    fn every_peer_makes_itself_and_has_a_name_of_its_own() {
        for (place, entry) in PEERS.iter().enumerate() {
            assert!((entry.make)(&Parameters::new()).is_ok(), "{}", entry.name);
            let others = MESHERS.iter().chain(&PEERS[..place]);
            assert!(
                others.into_iter().all(|other| other.name != entry.name),
                "{}",
                entry.name
            );
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
        let given = Parameters::from_iter([("angel".to_owned(), 30.into())]);
        assert_eq!(
            peer("triangle", &given).err().as_deref(),
            Some("there is no parameter `angel`")
        );
        let given = Parameters::from_iter([("size".to_owned(), "some".into())]);
        assert!(peer("triangle", &given).err().is_some_and(|told| told.contains("size")));
    }
}
