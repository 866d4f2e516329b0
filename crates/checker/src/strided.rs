//! Asking whether to go on, once in so many looks: often enough to stop at once, seldom enough to cost nothing.

/// Looks between two questions; each costs a microsecond at most.
const LOOKS_BETWEEN_QUESTIONS: u32 = 256;

/// A question that is asked at every so manieth look.
#[derive(Clone, Copy)]
pub(crate) struct Strided<'a> {
    go_on: &'a dyn Fn() -> bool,
    looks: u32,
}

impl<'a> Strided<'a> {
    pub(crate) fn new(go_on: &'a dyn Fn() -> bool) -> Self {
        Self { go_on, looks: 0 }
    }

    /// Counts a look. None: given up.
    pub(crate) fn look(&mut self) -> Option<()> {
        self.looks += 1;
        if self.looks < LOOKS_BETWEEN_QUESTIONS {
            return Some(());
        }
        self.ask()
    }

    /// Asks now. None: given up.
    pub(crate) fn ask(&mut self) -> Option<()> {
        self.looks = 0;
        (self.go_on)().then_some(())
    }
}
