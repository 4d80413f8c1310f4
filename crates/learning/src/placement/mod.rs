//! Policies that place the fleet.
