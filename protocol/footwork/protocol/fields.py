"""The types of the messages' fields, every one bounded."""

from typing import Annotated

from msgspec import Meta

# Bounds refuse NaN and infinities too: neither is above a lower and below an upper bound.
Metres = Annotated[float, Meta(ge=-1e5, le=1e5)]
Radians = Annotated[float, Meta(ge=-1e5, le=1e5)]
Speed = Annotated[float, Meta(ge=0, le=20)]
Sign = Annotated[int, Meta(ge=-1, le=1)]
# Whole numbers stay exact in a peer whose only number is a double.
Counter = Annotated[int, Meta(ge=0, le=2**53 - 1)]
Sequence = Annotated[int, Meta(ge=1, le=2**53 - 1)]
CharacterNumber = Annotated[int, Meta(ge=0, le=65535)]
Index = Annotated[int, Meta(ge=-1, le=2**31 - 1)]
Version = Annotated[int, Meta(ge=0, le=2**31 - 1)]
Name = Annotated[str, Meta(max_length=64)]
Names = Annotated[tuple[Name, ...], Meta(max_length=256)]
ClipName = Annotated[str, Meta(max_length=256)]
Line = Annotated[str, Meta(max_length=1024)]
Text = Annotated[str, Meta(max_length=65536)]
Offset = tuple[Metres, Metres, Metres]
Offsets = Annotated[tuple[Offset, ...], Meta(max_length=256)]
VectorBytes = Annotated[bytes, Meta(min_length=12, max_length=12)]
RotationBytes = Annotated[bytes, Meta(min_length=16, max_length=16 * 256)]
# Empty, or as long as the server makes them.
Token = Annotated[bytes, Meta(max_length=16)]
SpeedRanges = Annotated[dict[Name, tuple[Speed, Speed]], Meta(max_length=256)]
# Of 1; a blow may take more than is left.
Share = Annotated[float, Meta(ge=-1, le=1)]
CharacterPairs = Annotated[tuple[tuple[CharacterNumber, CharacterNumber], ...], Meta(max_length=65536)]
Kinds = Annotated[tuple[Name, ...], Meta(max_length=16)]
CharacterNumbers = Annotated[tuple[CharacterNumber, ...], Meta(max_length=65536)]
