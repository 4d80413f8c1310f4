//! Integration tests of the system.

mod placement;
mod placement_instance;
