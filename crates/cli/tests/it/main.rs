//! The command line and the house, from outside.

mod architecture;
