# The project's commands by name: `just --list`.

# Run the embedded scenario
run:
    cargo run --release -- run

# The tests
test:
    cargo test --workspace

# Formatting, clippy and documentation, warnings denied
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps

# Everything that must hold before a change lands
ci:
    .ci/run
