//! Integration tests of the system.

mod assignment;
mod loss_cache;
mod navigation;
mod navigation_instance;
mod placement;
mod placement_instance;
mod placement_mdp;
