//! Jobs on several threads, with the results in the jobs' own order: the number of threads changes nothing.

use std::{
    num::NonZero,
    sync::{
        atomic::{AtomicUsize, Ordering},
        mpsc,
    },
    thread,
};

/// Does jobs 0 to `count` − 1 on some threads; `done` hears of each that is over, in whatever order that happens.
///
/// # Errors
/// Those of the first job to fail.
pub fn in_order<T: Send>(
    count: usize,
    threads: NonZero<usize>,
    job: impl Fn(usize) -> Result<T, String> + Sync,
    mut done: impl FnMut(&T),
) -> Result<Vec<T>, String> {
    let (next, job) = (AtomicUsize::new(0), &job);
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..threads.get() {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count || sender.send((index, job(index))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        let mut results = Vec::with_capacity(count);
        for (index, result) in receiver {
            let result = result?;
            done(&result);
            results.push((index, result));
        }
        results.sort_by_key(|(index, _)| *index);
        Ok(results.into_iter().map(|(_, result)| result).collect())
    })
}
