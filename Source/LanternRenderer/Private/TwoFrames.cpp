// Buffers of two halves, which frames of a view take in turn.
#include "TwoFrames.h"

#include "LanternCore/FrameGraph/History.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

bool RequireTwoFrames(FFrameContext& Context, const char* Name, uint64_t Bytes, FTwoFrames& Out)
{
	FHistoryBuffer History;
	if (FRTStatus Status = Context.History->GetBuffer(Name, {2 * Bytes}, History); !Status)
	{
		Context.Fail(Status);
		return false;
	}
	const uint64_t Half = Context.MovedCasters->GetTurn() % 2; // frame numbers count those of other views, too
	Out.Buffer = History.Buffer;
	Out.Offset = Half * Bytes;
	Out.PreviousOffset = (1 - Half) * Bytes;
	Out.bPrevious = History.bOfLastFrame && !Context.View.bCut; // a cut shows another place
	return true;
}

} // namespace Lantern
