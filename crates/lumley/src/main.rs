//! The command `lumley`.

use std::process::ExitCode;

fn main() -> ExitCode {
    lumley::command::main()
}
