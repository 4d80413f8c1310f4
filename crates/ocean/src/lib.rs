//! ocean
