//! Integration tests of the system.

mod assignment;
mod navigation;
mod navigation_instance;
mod placement;
mod placement_instance;
