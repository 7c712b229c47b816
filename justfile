# Recipes for those who work on lumley.

# Run the main case
run:
    cargo run --release -- run cases/piston/case.toml

# All tests, as the README has them
test:
    cargo test --release

# Everything that CI checks
ci:
    bash .ci/run

# The reference numbers
verify:
    cargo run --release -- verify

# Benchmarks (criterion), beside the workspace
bench:
    cargo bench --manifest-path bench/Cargo.toml

# Formatting and lints
lint:
    cargo fmt --all
    cargo clippy --release --workspace --all-targets -- -D warnings
