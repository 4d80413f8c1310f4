//! The command line and the house, from outside.

mod architecture;
mod bad_input;
mod bellhop;
mod closed_loop;
mod links;
mod loss_tables;
mod placement;
mod program;
mod reproduce;
