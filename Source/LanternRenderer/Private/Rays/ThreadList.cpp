// Empty lists of threads.
#include "Rays/ThreadList.h"

namespace Lantern
{

FGraphBuffer AddThreadList(FFrameContext& Context, uint64_t Most, const char* Name)
{
	const uint64_t Bytes = sizeof(FThreadList) + Most * sizeof(uint32_t);
	const FGraphBuffer List = Context.Graph.CreateBuffer({Bytes, ERTBufferUsage::Indirect | ERTBufferUsage::CopyDest}, Name);
	Context.Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(List, ERTAccess::CopyWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			constexpr uint64_t Word = sizeof(uint32_t), Groups = offsetof(FThreadList, Groups), Launch = offsetof(FThreadList, Launch);
			const auto Fill = [&](uint64_t Offset, uint64_t Size, uint32_t Value) {
				Pass.Commands().FillBuffer(Pass.GetBuffer(List), Offset, Size, Value);
			};
			Fill(Groups, Word, RAY_QUEUE_ROW_GROUPS);
			Fill(Groups + Word, Word, 0);
			Fill(Groups + 2 * Word, Word, 1);
			Fill(Launch, Word, 0);
			Fill(Launch + Word, 2 * Word, 1);
		};
	});
	return List;
}

} // namespace Lantern
