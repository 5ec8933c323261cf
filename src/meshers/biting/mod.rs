//! Biting (§5.1).
