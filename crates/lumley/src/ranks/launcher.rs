use std::env;

/// What a launcher tells every process that it starts, and what a batch script does not see.
/// `SLURM_NTASKS` is not among them: it stands in the script of `sbatch`, where one process runs.
/// Open MPI's comes first: its `mpirun` may itself have been started as a step of Slurm.
const WORLD_SIZES: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"];

/// How many processes were started together with this one; 1 without a launcher.
///
/// Needs no MPI: it reads the environment that Open MPI (`OMPI_COMM_WORLD_SIZE`), MPICH, Intel
/// MPI and Cray (`PMI_SIZE`) and Slurm's `srun` (`SLURM_STEP_NUM_TASKS`) give to their processes.
/// What such a process starts in its turn inherits these, and is counted too.
///
/// ```
/// assert!(lumley::ranks::launched_processes() >= 1);
/// ```
pub fn launched_processes() -> usize {
    world_size(|name| env::var(name).ok())
}

fn world_size(variable: impl Fn(&str) -> Option<String>) -> usize {
    let size = |name: &&str| variable(name)?.parse().ok().filter(|&n| n > 0);
    WORLD_SIZES.iter().find_map(size).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::world_size;

    fn with(environment: &[(&str, &str)]) -> usize {
        world_size(|name| environment.iter().find(|(n, _)| *n == name).map(|(_, v)| v.to_string()))
    }

    #[test]
    fn each_launcher_is_noticed() {
        assert_eq!(with(&[("OMPI_COMM_WORLD_SIZE", "4"), ("PMIX_RANK", "0")]), 4);
        assert_eq!(with(&[("PMI_SIZE", "3"), ("PMI_RANK", "2")]), 3);
        assert_eq!(with(&[("SLURM_NTASKS", "2"), ("SLURM_STEP_NUM_TASKS", "2")]), 2);
    }

    #[test]
    fn a_batch_script_is_one_process() {
        assert_eq!(with(&[("SLURM_NTASKS", "64"), ("SLURM_NPROCS", "64")]), 1);
        assert_eq!(with(&[]), 1);
    }

    #[test]
    fn mpirun_inside_a_step_of_slurm_decides() {
        assert_eq!(with(&[("SLURM_STEP_NUM_TASKS", "2"), ("OMPI_COMM_WORLD_SIZE", "1")]), 1);
    }

    #[test]
    fn what_is_no_count_is_passed_over() {
        assert_eq!(with(&[("OMPI_COMM_WORLD_SIZE", ""), ("PMI_SIZE", "2")]), 2);
        assert_eq!(with(&[("PMI_SIZE", "0")]), 1);
        assert_eq!(with(&[("PMI_SIZE", "-1")]), 1);
    }
}
