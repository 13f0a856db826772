"""The protocol's messages: those that cannot be read are answered with an error, as JSON-RPC asks
for.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from cattrs import transform_error
from cattrs.errors import ClassValidationError
from lsprotocol import types
from pygls.exceptions import (
    JsonRpcException,
    JsonRpcInvalidParams,
    JsonRpcInvalidRequest,
    JsonRpcMethodNotFound,
    JsonRpcParseError,
)
from pygls.protocol import LanguageServerProtocol, lsp_method
from pygls.protocol.json_rpc import RPCMessage

MAX_REASONS = 3
"""What an answer says about a message that cannot be read."""


class Protocol(LanguageServerProtocol):
    """The protocol, without the texts that pygls keeps of documents: it takes U+2028 and others for
    line ends, and changes positions.
    """

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(
        self, params: types.DidChangeTextDocumentParams
    ) -> Iterator[tuple[object, ...]]:
        """Calls the feature alone."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CHANGE], (params,), None

    def structure_message(self, data: dict[str, Any]) -> object:
        """A message with its types. A request that has others is answered with what is wrong in it;
        a notification has no answer.
        """
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            method = data.get("method")
            if "id" in data and method is not None:
                unknown = not isinstance(method, str) or self.get_message_type(method) is None
                self._answer(
                    data["id"],
                    JsonRpcMethodNotFound.of(str(method)) if unknown else _invalid(error),
                )
            raise

    def handle_message(self, message: RPCMessage | object) -> None:
        """Handles a message. What is not a message, a batch, and a request after shutdown are
        answered with an error.
        """
        number = message.get("id") if isinstance(message, dict) else getattr(message, "id", None)
        is_message = hasattr(message, "jsonrpc")
        is_request = is_message and hasattr(message, "method") and number is not None
        if not is_message or (
            is_request and (self._shutdown or not isinstance(number, (str, int)))
        ):
            self._answer(number, JsonRpcInvalidRequest())
        else:
            super().handle_message(message)  # type: ignore[arg-type]

    def answer_unreadable(self) -> None:
        """Answers what is not JSON."""
        self._answer(None, JsonRpcParseError())

    def _answer(self, number: object, error: JsonRpcException) -> None:
        identifier = number if isinstance(number, (str, int)) else None
        self._send_data(types.ResponseErrorMessage(id=identifier, error=error.to_response_error()))


def _invalid(error: JsonRpcException) -> JsonRpcInvalidParams:
    """What is wrong in the parameters of a request, with the path of each."""
    cause = error.__cause__
    reasons = transform_error(cause, "$") if isinstance(cause, ClassValidationError) else []
    return JsonRpcInvalidParams("; ".join([JsonRpcInvalidParams.MESSAGE, *reasons[:MAX_REASONS]]))
