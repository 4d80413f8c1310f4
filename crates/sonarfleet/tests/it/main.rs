//! Integration tests of the system.

mod assignment;
mod navigation;
mod navigation_instance;
