//! What a person sees of long work: a bar on a terminal, plain lines elsewhere, always on stderr.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// Seconds between plain lines.
const QUIET: Duration = Duration::from_secs(10);

/// Progress of one stage.
///
/// ```
/// use lumley::progress::Progress;
/// let mut progress = Progress::silent();
/// progress.begin("full-order model", 200);
/// progress.advance(100, "X = 0.95 m");
/// progress.end("200 snapshots");
/// ```
#[derive(Debug)]
pub struct Progress {
    loud: bool,
    stage: String,
    length: usize,
    started: Instant,
    part_started: Instant,
    done_before: usize,
    spoken: Instant,
    bar: ProgressBar,
}

impl Progress {
    /// Progress on stderr.
    pub fn stderr() -> Self {
        Self::new(true)
    }

    /// No output at all.
    pub fn silent() -> Self {
        Self::new(false)
    }

    fn new(loud: bool) -> Self {
        let now = Instant::now();
        let (stage, bar) = (String::new(), ProgressBar::hidden());
        Self {
            loud,
            stage,
            length: 0,
            started: now,
            part_started: now,
            done_before: 0,
            spoken: now,
            bar,
        }
    }

    /// A stage of `length` parts begins.
    pub fn begin(&mut self, stage: &str, length: usize) {
        stage.clone_into(&mut self.stage);
        self.length = length;
        self.started = Instant::now();
        (self.part_started, self.done_before) = (self.started, 0);
        self.spoken = self.started;
        if self.loud && io::stderr().is_terminal() {
            let bar =
                ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr());
            let style = "{prefix:>20} {wide_bar} {percent:>3} %  {per_sec}  {eta} left  {msg}";
            if let Ok(style) = ProgressStyle::with_template(style) {
                bar.set_style(style);
            }
            bar.set_prefix(stage.to_owned());
            self.bar = bar;
        }
    }

    /// A part of the stage begins, of `length` pieces of its own, `done` of which were done before.
    pub fn part(&mut self, length: usize, done: usize) {
        (self.length, self.done_before) = (length, done);
        self.part_started = Instant::now();
        self.bar.set_length(length as u64);
        self.bar.set_position(done as u64);
        self.bar.reset_eta();
    }

    /// `done` parts of the stage are done.
    pub fn advance(&mut self, done: usize, message: &str) {
        if !self.bar.is_hidden() {
            self.bar.set_position(done as u64);
            self.bar.set_message(message.to_owned());
        } else if self.loud && self.spoken.elapsed() > QUIET {
            self.spoken = Instant::now();
            let passed = self.part_started.elapsed().as_secs_f64();
            let now_done = done.saturating_sub(self.done_before).max(1);
            let left = passed / now_done as f64 * self.length.saturating_sub(done) as f64;
            let Self { stage, length, .. } = self;
            tell(&format!("{stage:>20}  {done} of {length}  {left:.0} s left  {message}"));
        }
    }

    /// The stage is done; `message` says what came of it. Returns its time, in s.
    pub fn end(&mut self, message: &str) -> f64 {
        let seconds = self.started.elapsed().as_secs_f64();
        self.bar.finish_and_clear();
        self.bar = ProgressBar::hidden();
        if self.loud {
            tell(&format!("{:>20}  {message}  ({seconds:.2} s)", self.stage));
        }
        seconds
    }

    /// What the person should know, a line each.
    pub fn warn(&self, messages: &[String]) {
        if self.loud {
            for message in messages {
                self.bar.suspend(|| tell(&format!("{:>20}  {message}", "warning:")));
            }
        }
    }
}

/// A line on stderr, whole beside those of other processes. Where it cannot be written, as to a log on a
/// full disk, nobody hears it and the work goes on.
pub(crate) fn tell(line: &str) {
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}
