//! Pages made from the rows alone.
