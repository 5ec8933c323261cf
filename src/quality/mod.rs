//! Judges a mesh from domain, spacing, c_b and mesh alone. Imports no mesher.
