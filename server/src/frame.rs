//! gRPC's framing of one message: a flag, four bytes of length, the message.

use bytes::{BufMut, Bytes, BytesMut};
use traverse_proto::Refused;

/// Bytes before the message.
pub(crate) const HEADER: usize = 5;

const COMPRESSED: u8 = 1;

/// The frame of an uncompressed message. Messages are below 4 GiB: configuration sees to it.
pub(crate) fn framed(message: &[u8]) -> Bytes {
    let mut frame = BytesMut::with_capacity(HEADER + message.len());
    frame.put_u8(0);
    frame.put_u32(u32::try_from(message.len()).unwrap_or(u32::MAX));
    frame.put_slice(message);
    frame.freeze()
}

/// What the head of a frame says can't be taken. Says nothing before the head is complete.
pub(crate) fn check_head(read: &[u8], limit: usize, encoding: Option<&str>) -> Result<(), Refused> {
    let Some(&[flag, a, b, c, d]) = read.first_chunk::<HEADER>() else { return Ok(()) };
    let length = u32::from_be_bytes([a, b, c, d]);
    match flag {
        0 if length as usize > limit => Err(Refused::MessageTooLarge { bytes: length.into(), limit }),
        0 => Ok(()),
        COMPRESSED => {
            Err(Refused::UnsupportedEncoding { encoding: encoding.unwrap_or("compressed").to_owned() })
        }
        flag => Err(malformed(format!("a gRPC frame begins with 0 or 1, not with {flag}"))),
    }
}

/// How long the frame is that `read` begins with, its head included; none before the head is complete.
pub(crate) fn length(read: &[u8]) -> Option<usize> {
    let &[_, a, b, c, d] = read.first_chunk::<HEADER>()?;
    Some(HEADER + u32::from_be_bytes([a, b, c, d]) as usize)
}

/// The one message of a request.
pub(crate) fn message(request: &[u8]) -> Result<&[u8], Refused> {
    let Some((&[_, a, b, c, d], message)) = request.split_first_chunk::<HEADER>() else {
        return Err(malformed(format!(
            "a gRPC frame has {HEADER} bytes before the message, the request has {} in all",
            request.len()
        )));
    };
    let length = u32::from_be_bytes([a, b, c, d]) as usize;
    if message.len() == length {
        return Ok(message);
    }
    Err(malformed(format!("the gRPC frame announces {length} bytes and {} follow", message.len())))
}

fn malformed(detail: String) -> Refused {
    Refused::MalformedMessage { detail }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_comes_out_as_it_went_in() {
        for bytes in [&b""[..], b"x", b"message"] {
            let frame = framed(bytes);
            assert_eq!(check_head(&frame, 7, None), Ok(()));
            assert_eq!(message(&frame), Ok(bytes));
        }
    }

    #[test]
    fn what_is_no_frame_is_named() {
        let reason = |result: Result<(), Refused>| result.err().map(|refused| refused.reason());
        assert_eq!(reason(check_head(&[0, 0, 0, 0, 8], 7, None)), Some("MESSAGE_TOO_LARGE"));
        assert_eq!(reason(check_head(&[0, 0xff, 0xff, 0xff, 0xff], 7, None)), Some("MESSAGE_TOO_LARGE"));
        assert_eq!(reason(check_head(&[1, 0, 0, 0, 0], 7, Some("gzip"))), Some("UNSUPPORTED_ENCODING"));
        assert_eq!(reason(check_head(b"<html", 7, None)), Some("MALFORMED_MESSAGE"));
        assert_eq!(reason(check_head(b"<htm", 7, None)), None);
        for wrong in [&b""[..], b"\0\0", b"\0\0\0\0\x02x", b"\0\0\0\0\x01xx", b"\0\0\0\0\0\0\0\0\0\0"] {
            assert_eq!(
                message(wrong).err().map(|refused| refused.reason()),
                Some("MALFORMED_MESSAGE"),
                "{wrong:?}"
            );
        }
    }
}
