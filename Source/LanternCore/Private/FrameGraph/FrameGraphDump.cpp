// Prints the graph as text, for people and for tests.
#include <fmt/format.h>

#include "FrameGraph/FrameGraphImpl.h"

namespace Lantern
{

namespace
{

std::string DumpUses(const FGraphPass& Pass, const std::vector<FGraphResource>& Resources)
{
	std::string Text;
	for (const FPassUse& Use : Pass.Uses)
	{
		const std::string& Name = Resources[Use.Resource].Name;
		if (Use.Read != ERTAccess::None) { Text += fmt::format("      read    {}  {}\n", Name, ToString(Use.Read)); }
		if (Use.Write != ERTAccess::None) { Text += fmt::format("      write   {}  {}\n", Name, ToString(Use.Write)); }
	}
	for (const uint32_t Kept : Pass.Keeps) { Text += fmt::format("      keep    {}\n", Resources[Kept].Name); }
	return Text;
}

std::string DumpBarriers(const std::vector<FGraphBarrier>& Barriers, const std::vector<FGraphResource>& Resources)
{
	std::string Text;
	for (const FGraphBarrier& Barrier : Barriers)
	{
		Text += fmt::format(
		    "      barrier {}  {} -> {}\n", Resources[Barrier.Resource].Name, ToString(Barrier.Before), ToString(Barrier.After));
	}
	return Text;
}

std::string DumpResource(const FGraphResource& Resource)
{
	std::string Text = fmt::format("  {}, {}", Resource.Describe(), Resource.bImported ? "imported" : "transient");
	if (Resource.FirstPass == NoPass) { return Text + ", unused\n"; }
	Text += fmt::format(", passes {} to {}", Resource.FirstPass, Resource.LastPass);
	if (Resource.Pooled)
	{
		Text += fmt::format(", {} bytes", Resource.Pooled->Key.GetBytes());
		Text += Resource.Pooled->Name != Resource.Name ? fmt::format(", in place of '{}'", Resource.Pooled->Name) : "";
	}
	return Text + "\n";
}

} // namespace

std::string FFrameGraph::Dump() const
{
	size_t BarrierCount = Impl->FinalBarriers.size();
	std::string Body;
	for (size_t Index = 0; Index < Impl->Passes.size(); ++Index)
	{
		const FGraphPass& Pass = Impl->Passes[Index];
		BarrierCount += Pass.Barriers.size();
		Body += fmt::format("  {:3} {}{}\n", Index, Pass.Name, Pass.bCulled ? " (culled)" : "");
		Body += DumpBarriers(Pass.Barriers, Impl->Resources) + DumpUses(Pass, Impl->Resources);
	}
	if (!Impl->FinalBarriers.empty()) { Body += "  end\n" + DumpBarriers(Impl->FinalBarriers, Impl->Resources); }
	Body += "resources\n";
	for (const FGraphResource& Resource : Impl->Resources) { Body += DumpResource(Resource); }
	return fmt::format("frame graph: {} passes, {} culled, {} barriers\n{}", GetPassCount(), GetCulledPassCount(), BarrierCount, Body);
}

} // namespace Lantern
