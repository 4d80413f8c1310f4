//! sonar
