//! The contract as data: which calls there are and what they take and answer.

use prost_reflect::{DescriptorPool, MessageDescriptor, MethodDescriptor};
use std::sync::LazyLock;

/// Full name of the planner's service.
pub const PLANNER_SERVICE: &str = "traverse.v1.PlannerService";

static CONTRACT: LazyLock<DescriptorPool> = LazyLock::new(|| {
    DescriptorPool::decode(crate::FILE_DESCRIPTOR_SET)
        .expect("invariant: build.rs wrote a valid descriptor set")
});

/// What error details are made of, to show them as JSON.
static ERROR_DETAILS: LazyLock<DescriptorPool> = LazyLock::new(|| {
    let mut pool = CONTRACT.clone();
    // Without these types details are only shown encoded.
    pool.decode_file_descriptor_set(tonic_types::pb::FILE_DESCRIPTOR_SET).ok();
    pool
});

/// One call of the contract.
#[derive(Clone, Debug)]
pub struct Procedure {
    method: MethodDescriptor,
}

impl Procedure {
    /// The call at an HTTP path such as `/traverse.v1.PlannerService/PlanRapidMove`.
    #[must_use]
    pub fn at_path(path: &str) -> Option<Self> {
        let (service, method) = path.strip_prefix('/')?.split_once('/')?;
        let service = CONTRACT.get_service_by_name(service)?;
        service.methods().find(|candidate| candidate.name() == method).map(|method| Self { method })
    }

    /// The call of this name, with or without its service: `PlanRapidMove`, `traverse.v1.PlannerService/PlanRapidMove`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let bare = name.trim_start_matches('/');
        if bare.contains('/') {
            return Self::at_path(&format!("/{bare}"));
        }
        Self::all().find(|procedure| procedure.name() == bare)
    }

    /// Every call of the contract.
    pub fn all() -> impl Iterator<Item = Self> {
        CONTRACT
            .services()
            .flat_map(|service| service.methods().collect::<Vec<_>>())
            .map(|method| Self { method })
    }

    /// Its name without the service.
    #[must_use]
    pub fn name(&self) -> &str {
        self.method.name()
    }

    /// Its HTTP path.
    #[must_use]
    pub fn path(&self) -> String {
        format!("/{}/{}", self.method.parent_service().full_name(), self.method.name())
    }

    /// What it takes.
    #[must_use]
    pub fn input(&self) -> MessageDescriptor {
        self.method.input()
    }

    /// What it answers.
    #[must_use]
    pub fn output(&self) -> MessageDescriptor {
        self.method.output()
    }
}

/// The type of an error detail.
pub(crate) fn error_detail(name: &str) -> Option<MessageDescriptor> {
    ERROR_DETAILS.get_message_by_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn procedures_are_found_by_path_and_by_name() {
        let paths: Vec<String> = Procedure::all().map(|procedure| procedure.path()).collect();
        assert_eq!(paths.len(), 6);
        for path in &paths {
            assert_eq!(Procedure::at_path(path).expect("its own path").path(), *path);
        }
        assert_eq!(Procedure::named("PlanRapidMove").expect("by name").path(), paths[0]);
        for wrong in [
            "",
            "/",
            "/traverse.v1.PlannerService",
            "/traverse.v1.PlannerService/",
            "/x/PlanRapidMove",
            "/a/b/c",
        ] {
            assert!(Procedure::at_path(wrong).is_none(), "{wrong}");
        }
        assert!(error_detail("google.rpc.BadRequest").is_some());
    }
}
