//! A solver of one's own passes three claims.

#[path = "../examples/own_backend.rs"]
mod own_backend;

#[test]
fn own_backend_holds_three_claims() -> Result<(), Box<dyn std::error::Error>> {
    own_backend::main()
}
