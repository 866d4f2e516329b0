//! Faults of our own: logged in full under an id, told to the caller by that id alone.

use std::any::Any;
use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};
use traverse_proto::Refused;

/// What the caller is told of a panic.
pub(crate) fn of_panic(panic: &(dyn Any + Send)) -> Refused {
    let message = panic
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("of a kind that has no text");
    of(&format!("panic: {message}"))
}

/// What the caller is told of anything else that must not happen.
pub(crate) fn of(what: &str) -> Refused {
    let id = id();
    tracing::error!(id, "{what}");
    Refused::Internal { id }
}

/// Unlike any other, in this process and with near certainty in all of them.
fn id() -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let mut hasher = RandomState::new().build_hasher();
    hasher.write_u64(COUNT.fetch_add(1, Ordering::Relaxed));
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_differ() {
        let ids: std::collections::HashSet<String> = (0..1000).map(|_| id()).collect();
        assert_eq!(ids.len(), 1000);
    }
}
