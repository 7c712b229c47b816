//! Compiles the seam to MUMPS where the feature `mumps` asks for it.

fn main() {
    println!("cargo:rerun-if-changed=src/mumps.c");
    #[cfg(feature = "mumps")]
    {
        cc::Build::new().file("src/mumps.c").std("c99").compile("mumps_seam");
        println!("cargo:rustc-link-lib=dylib=dmumps_seq");
    }
}
