//! The engines' own threads behind a bounded queue. CPU work never runs on the async runtime, never waits unbounded, and
//! leaves the queue as soon as its caller is gone.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use traverse_solve::CancelToken;

type Work = Box<dyn FnOnce() + Send>;

struct Job {
    number: u64,
    entry: Entry,
    cancel: CancelToken,
    work: Work,
}

/// How work comes into the queue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entry {
    /// If there is room.
    Call,
    /// Always: a turn of a session, of which each has one at most.
    Turn,
}

#[derive(Default)]
struct Queue {
    jobs: VecDeque<Job>,
    /// How many of them are turns.
    turns: usize,
    next_number: u64,
    idle_workers: usize,
    closed: bool,
}

struct Shared {
    queue: Mutex<Queue>,
    work_came: Condvar,
    capacity: usize,
}

impl Shared {
    /// No code that can panic runs while the queue is locked.
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A fixed number of threads that work off a bounded queue. Dropping it lets running work end and forgets what waits.
pub(crate) struct Pool {
    shared: Arc<Shared>,
}

/// The queue is full.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct QueueFull {
    pub(crate) capacity: usize,
}

/// A piece of work that somebody waits for. Dropping it cancels the work: what runs is told to stop, what waits leaves the queue.
pub(crate) struct Ticket {
    number: u64,
    cancel: CancelToken,
    shared: Arc<Shared>,
}

impl Pool {
    /// Starts `workers` threads; `capacity` pieces of work may wait when all of them are busy.
    ///
    /// # Errors
    /// The system gives no more threads.
    pub(crate) fn start(workers: usize, capacity: usize) -> std::io::Result<Self> {
        let shared = Arc::new(Shared { queue: Mutex::default(), work_came: Condvar::new(), capacity });
        let pool = Self { shared };
        for number in 0..workers {
            let shared = Arc::clone(&pool.shared);
            std::thread::Builder::new().name(format!("engine-{number}")).spawn(move || work_off(&shared))?;
        }
        Ok(pool)
    }

    /// Queues work. `work` does not run when `cancel` was raised before its turn.
    pub(crate) fn submit(
        &self,
        entry: Entry,
        cancel: CancelToken,
        work: impl FnOnce() + Send + 'static,
    ) -> Result<Ticket, QueueFull> {
        let mut queue = self.shared.queue();
        // An idle worker takes what waits for it at once: that is not queueing.
        let calls = queue.jobs.len() - queue.turns;
        if entry == Entry::Call && calls >= self.shared.capacity.saturating_add(queue.idle_workers) {
            return Err(QueueFull { capacity: self.shared.capacity });
        }
        let number = queue.next_number;
        queue.next_number += 1;
        queue.turns += usize::from(entry == Entry::Turn);
        queue.jobs.push_back(Job { number, entry, cancel: cancel.clone(), work: Box::new(work) });
        drop(queue);
        self.shared.work_came.notify_one();
        Ok(Ticket { number, cancel, shared: Arc::clone(&self.shared) })
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        let mut queue = self.shared.queue();
        queue.closed = true;
        let forgotten = std::mem::take(&mut queue.jobs);
        queue.turns = 0;
        drop(queue);
        self.shared.work_came.notify_all();
        drop(forgotten);
    }
}

impl Drop for Ticket {
    fn drop(&mut self) {
        self.cancel.cancel();
        let mut queue = self.shared.queue();
        let place = queue.jobs.iter().position(|job| job.number == self.number);
        let job = place.and_then(|place| queue.jobs.remove(place));
        queue.turns -= job.iter().filter(|job| job.entry == Entry::Turn).count();
        drop(queue);
        drop(job);
    }
}

fn work_off(shared: &Shared) {
    while let Some(job) = next_job(shared) {
        if !job.cancel.is_cancelled() {
            // Work reports its own panics; this keeps the thread alive if it can't.
            drop(catch_unwind(AssertUnwindSafe(job.work)));
        }
    }
}

fn next_job(shared: &Shared) -> Option<Job> {
    let mut queue = shared.queue();
    queue.idle_workers += 1;
    loop {
        if queue.closed {
            return None;
        }
        if let Some(job) = queue.jobs.pop_front() {
            queue.idle_workers -= 1;
            queue.turns -= usize::from(job.entry == Entry::Turn);
            return Some(job);
        }
        queue = shared.work_came.wait(queue).unwrap_or_else(PoisonError::into_inner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{Receiver, Sender, channel};
    use std::time::Duration;

    const HANG: Duration = Duration::from_secs(60);

    /// Work that says when it begins and ends when told to.
    fn gate() -> (impl FnOnce() + Send, Receiver<()>, Sender<()>) {
        let (begun, has_begun) = channel();
        let (end, may_end) = channel::<()>();
        let work = move || {
            begun.send(()).ok();
            may_end.recv().ok();
        };
        (work, has_begun, end)
    }

    #[test]
    fn what_does_not_fit_is_refused_and_what_is_dropped_makes_room() {
        let pool = Pool::start(1, 1).expect("threads");
        let (work, begun, end) = gate();
        let running = pool.submit(Entry::Call, CancelToken::new(), work).expect("idle");
        begun.recv_timeout(HANG).expect("it runs");
        let waiting = pool
            .submit(Entry::Call, CancelToken::new(), || panic!("its caller is gone"))
            .expect("one may wait");
        assert_eq!(
            pool.submit(Entry::Call, CancelToken::new(), || ()).err(),
            Some(QueueFull { capacity: 1 })
        );
        drop(waiting);
        let (done, is_done) = channel();
        let next = pool
            .submit(Entry::Call, CancelToken::new(), move || done.send(()).expect("heard"))
            .expect("there is room again");
        end.send(()).expect("it waits");
        is_done.recv_timeout(HANG).expect("it runs");
        drop((running, next));
    }

    #[test]
    fn turns_wait_beside_calls_and_take_none_of_their_room() {
        let pool = Pool::start(1, 1).expect("threads");
        let (work, begun, end) = gate();
        let running = pool.submit(Entry::Call, CancelToken::new(), work).expect("idle");
        begun.recv_timeout(HANG).expect("it runs");
        let (done, order) = channel();
        let submit = |entry, name: &'static str| {
            let done = done.clone();
            pool.submit(entry, CancelToken::new(), move || done.send(name).expect("heard"))
        };
        let turns = [submit(Entry::Turn, "turn"), submit(Entry::Turn, "another turn")];
        let call = submit(Entry::Call, "call").expect("one may wait");
        assert!(submit(Entry::Call, "one too many").is_err());
        let [first, second] = turns.map(|turn| turn.expect("always"));
        drop(first);
        end.send(()).expect("it waits");
        let next = || order.recv_timeout(HANG).expect("it runs");
        assert_eq!([next(), next()], ["another turn", "call"], "in the order in which they came");
        drop((running, second, call));
    }

    #[test]
    fn a_panic_does_not_cost_a_worker() {
        let pool = Pool::start(1, 8).expect("threads");
        let tickets: Vec<Ticket> = (0..4)
            .map(|_| pool.submit(Entry::Call, CancelToken::new(), || panic!("on purpose")).expect("room"))
            .collect();
        let (done, is_done) = channel();
        let last = pool
            .submit(Entry::Call, CancelToken::new(), move || done.send(()).expect("heard"))
            .expect("room");
        is_done.recv_timeout(HANG).expect("the worker lives");
        drop((tickets, last));
    }
}
