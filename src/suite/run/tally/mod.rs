//! Groups that are tallied: families of many small cases, each judged by the full certificate, counted in place of a row each.
//!
//! [`family`] says which case has which number, [`trial`] runs one, [`worker`] does so in a process of its own that may
//! die or hang, [`campaign`] deals the cases out in chunks, each of which leaves a line in the journal.
//!
//! Every case is a function of family and number, and can be run again by [`family::Trial::command`].

pub mod campaign;
pub mod family;
pub mod trial;
pub mod worker;
