//! What a Connect request says in its headers.

use crate::session::Framing;
use http::{HeaderMap, header};
use std::time::Duration;
use traverse_proto::Refused;

/// Encodings that a request's body can have. Connect names them by content type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Json,
    Proto,
}

impl Encoding {
    /// The encoding that the content type names, if it is one of these.
    pub(super) fn of(headers: &HeaderMap) -> Option<Self> {
        let content_type = headers.get(header::CONTENT_TYPE)?.to_str().ok()?;
        let (kind, parameters) = content_type.split_once(';').unwrap_or((content_type, ""));
        let utf_8 = parameters.split_once('=').is_none_or(|(name, value)| {
            !name.trim().eq_ignore_ascii_case("charset")
                || value.trim().trim_matches('"').eq_ignore_ascii_case("utf-8")
        });
        match kind.trim().to_ascii_lowercase().as_str() {
            "application/json" if utf_8 => Some(Self::Json),
            "application/proto" => Some(Self::Proto),
            _ => None,
        }
    }

    pub(super) fn content_type(self) -> &'static str {
        match self {
            Self::Json => "application/json",
            Self::Proto => "application/proto",
        }
    }
}

/// The framing of a session that the content type names, if it is one of Connect's streaming form.
pub(super) fn session_framing(headers: &HeaderMap) -> Option<Framing> {
    let content_type = headers.get(header::CONTENT_TYPE)?.to_str().ok()?;
    let kind = content_type.split_once(';').map_or(content_type, |(kind, _)| kind);
    match kind.trim().to_ascii_lowercase().as_str() {
        "application/connect+json" => Some(Framing::ConnectJson),
        "application/connect+proto" => Some(Framing::ConnectProto),
        _ => None,
    }
}

/// Whether the headers other than the content type can be served, with the body's encoding named by `encoding`; and how
/// long the caller waits.
pub(super) fn timeout(
    headers: &HeaderMap,
    encoding: &header::HeaderName,
) -> Result<Option<Duration>, Refused> {
    if let Some(encoding) = headers.get(encoding)
        && encoding.as_bytes() != b"identity"
    {
        return Err(Refused::UnsupportedEncoding {
            encoding: String::from_utf8_lossy(encoding.as_bytes()).into_owned(),
        });
    }
    if let Some(version) = headers.get("connect-protocol-version")
        && version.as_bytes() != b"1"
    {
        return Err(Refused::MalformedHeader {
            detail: format!("connect-protocol-version is {version:?}; send 1"),
        });
    }
    let Some(value) = headers.get("connect-timeout-ms") else { return Ok(None) };
    let digits =
        value.to_str().ok().filter(|text| text.len() <= 10 && text.bytes().all(|byte| byte.is_ascii_digit()));
    let milliseconds = digits.and_then(|digits| digits.parse().ok());
    milliseconds.map(|milliseconds| Some(Duration::from_millis(milliseconds))).ok_or_else(|| {
        Refused::MalformedHeader { detail: format!("connect-timeout-ms is {value:?}; send 1 to 10 digits") }
    })
}
