// The registry of console variables: who may set a value, and its publication to the render thread.
#include "LanternCore/Config/ConsoleVariables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "Config/ConsoleVariableRegistry.h"
#include "Config/ConsoleVariableValues.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Text/TextTools.h"

namespace Lantern
{

const char* ToString(ERTSetBy By)
{
	switch (By)
	{
	case ERTSetBy::Code: return "code";
	case ERTSetBy::Ini: return "ini";
	case ERTSetBy::Scalability: return "scalability";
	case ERTSetBy::DeviceProfile: return "device profile";
	case ERTSetBy::CommandLine: return "command line";
	case ERTSetBy::Console: return "console";
	}
	return "unknown";
}

// The variable.

FRTConsoleVariable::FRTConsoleVariable(const char* Name, const FRTCVarValue& Default, const char* Help, FRTCVarRange Range)
    : State(new FState{.Name = Name, .Help = Help, .Default = Default, .Range = Range, .Latest = Default, .Published = Default})
{
	assert(Range.Min <= Range.Max);
	assert(IsInRange(Default, Range));
	FConsoleVariables::Get().Impl->Register(*this);
}

FRTConsoleVariable::~FRTConsoleVariable() { FConsoleVariables::Get().Impl->Unregister(*this); }

const std::string& FRTConsoleVariable::GetName() const { return State->Name; }

const std::string& FRTConsoleVariable::GetHelp() const { return State->Help; }

const FRTCVarValue& FRTConsoleVariable::GetDefault() const { return State->Default; }

FRTCVarRange FRTConsoleVariable::GetRange() const { return State->Range; }

ERTSetBy FRTConsoleVariable::GetSetBy() const
{
	std::shared_lock Lock(FConsoleVariables::Get().Impl->Mutex);
	return State->SetBy;
}

FRTCVarValue FRTConsoleVariable::GetValue() const
{
	std::shared_lock Lock(FConsoleVariables::Get().Impl->Mutex);
	return State->Latest;
}

void FRTConsoleVariable::SetCallback(std::function<void(const FRTConsoleVariable&)> Callback)
{
	std::unique_lock Lock(FConsoleVariables::Get().Impl->Mutex);
	State->Callback = std::move(Callback);
}

template <class T>
const T& TRTConsoleVariable<T>::GetOnRenderThread() const
{
	return std::get<T>(State->Published);
}

template const bool& TRTConsoleVariable<bool>::GetOnRenderThread() const;
template const int32_t& TRTConsoleVariable<int32_t>::GetOnRenderThread() const;
template const float& TRTConsoleVariable<float>::GetOnRenderThread() const;
template const std::string& TRTConsoleVariable<std::string>::GetOnRenderThread() const;

// FConsoleVariables::FImpl.

void FConsoleVariables::FImpl::Register(FRTConsoleVariable& Variable)
{
	std::unique_lock Lock(Mutex);
	[[maybe_unused]] const bool bNew = Variables.emplace(FoldCase(Variable.GetName()), &Variable).second;
	assert(bNew && "two console variables of one name");
}

void FConsoleVariables::FImpl::Unregister(FRTConsoleVariable& Variable)
{
	std::unique_lock Lock(Mutex);
	std::erase_if(Variables, [&](const auto& Entry) { return Entry.second == &Variable; });
	std::erase(Dirty, &Variable);
}

FConsoleVariables::FImpl::FFound FConsoleVariables::FImpl::Find(std::string_view NameOrAlias) const
{
	std::string Name = FoldCase(NameOrAlias);
	double Factor = 1.0;
	// An alias may lead to an alias. Limiting the steps to the number of aliases ends any cycle.
	for (size_t Step = 0; Step <= Aliases.size(); ++Step)
	{
		if (const auto Variable = Variables.find(Name); Variable != Variables.end()) return {Variable->second, Factor};
		const auto Alias = Aliases.find(Name);
		if (Alias == Aliases.end()) return {};
		Name = FoldCase(Alias->second.Name);
		Factor *= Alias->second.Factor;
	}
	return {};
}

std::string FConsoleVariables::FImpl::DescribeUnknown(std::string_view Name) const
{
	std::vector<std::string_view> Known;
	for (const auto& [Folded, Variable] : Variables) Known.push_back(Variable->GetName());
	for (const auto& [Folded, Alias] : Aliases) Known.push_back(Alias.Alias);
	std::string Message = fmt::format("unknown console variable {}", Quote(Name));
	if (!Known.empty()) Message += fmt::format("; the nearest name is {}", Quote(FindNearest(Name, Known)));
	return Message;
}

void FConsoleVariables::FImpl::MarkDirty(FRTConsoleVariable& Variable)
{
	if (Variable.State->bDirty) return;
	Variable.State->bDirty = true;
	Dirty.push_back(&Variable);
}

// The registry.

FConsoleVariables::FConsoleVariables() : Impl(std::make_unique<FImpl>()) {}

FConsoleVariables::~FConsoleVariables() = default;

FConsoleVariables& FConsoleVariables::Get()
{
	// Never destroyed: variables have static storage in many files and unregister in an unknown order.
	static FConsoleVariables* Instance = new FConsoleVariables;
	return *Instance;
}

FConsoleVariables::FImpl::FOutcome FConsoleVariables::FImpl::Set(std::string_view Name, std::string_view Value, ERTSetBy By)
{
	std::unique_lock Lock(Mutex);
	const auto [Variable, Factor] = Find(Name);
	if (!Variable) return {.bRefused = true, .Warning = DescribeUnknown(Name)};

	FRTConsoleVariable::FState& State = *Variable->State;
	FParsedCVar Parsed = ParseCVar(State.Default, State.Range, Value, Factor);
	std::string Range = DescribeRange(State.Default, State.Range);
	if (!Parsed.Value)
		return {.bRefused = true,
		    .Warning = fmt::format("{}: {} {}{}{}", State.Name, Quote(Value), Parsed.Error, Range.empty() ? "" : "; range: ", Range)};
	if (By < State.SetBy) return {};

	FOutcome Outcome;
	if (Parsed.ClampedTo != 0 && Parsed.ClampedTo != State.ClampWarned)
		Outcome.Warning = fmt::format("{}: {} is out of range ({}); {} is used", State.Name, Quote(Value),
		    Range.empty() ? "the limits of its type" : Range, ToString(*Parsed.Value));
	State.ClampWarned = Parsed.ClampedTo;
	State.SetBy = By;
	State.Latest = std::move(*Parsed.Value);
	MarkDirty(*Variable);
	return Outcome;
}

std::optional<std::string> FConsoleVariables::Set(std::string_view Name, std::string_view Value, ERTSetBy By, std::string_view Where)
{
	FImpl::FOutcome Outcome = Impl->Set(Trim(Name), Value, By);
	if (Outcome.Warning.empty()) return std::nullopt;
	if (!Where.empty()) Outcome.Warning = fmt::format("{}: {}", Where, Outcome.Warning);
	// Logged outside the lock: a log sink may ask for a variable.
	LogLine(ERTLogLevel::Warning, Outcome.Warning);
	return Outcome.bRefused ? std::optional(std::move(Outcome.Warning)) : std::nullopt;
}

const FRTConsoleVariable* FConsoleVariables::Find(std::string_view NameOrAlias) const
{
	std::shared_lock Lock(Impl->Mutex);
	return Impl->Find(NameOrAlias).Variable;
}

std::vector<const FRTConsoleVariable*> FConsoleVariables::GetAll() const
{
	std::shared_lock Lock(Impl->Mutex);
	std::vector<const FRTConsoleVariable*> Result;
	for (const auto& [Folded, Variable] : Impl->Variables) Result.push_back(Variable);
	return Result;
}

void FConsoleVariables::AddAlias(std::string_view Alias, std::string_view Name, double Factor)
{
	assert(std::isfinite(Factor) && Factor != 0.0);
	std::unique_lock Lock(Impl->Mutex);
	Impl->Aliases.insert_or_assign(FoldCase(Alias), FImpl::FAlias{std::string(Alias), std::string(Name), Factor});
}

std::vector<std::pair<std::string, std::string>> FConsoleVariables::GetAliases() const
{
	std::shared_lock Lock(Impl->Mutex);
	std::vector<std::pair<std::string, std::string>> Result;
	for (const auto& [Folded, Alias] : Impl->Aliases) Result.emplace_back(Alias.Alias, Alias.Name);
	return Result;
}

void FConsoleVariables::BeginFrame()
{
	using FCallback = std::function<void(const FRTConsoleVariable&)>;
	std::vector<std::pair<FCallback, FRTConsoleVariable*>> Callbacks;
	{
		std::unique_lock Lock(Impl->Mutex);
		for (FRTConsoleVariable* Variable : Impl->Dirty)
		{
			FRTConsoleVariable::FState& State = *Variable->State;
			State.bDirty = false;
			if (State.Published == State.Latest) continue;
			State.Published = State.Latest;
			if (State.Callback) Callbacks.emplace_back(State.Callback, Variable);
		}
		Impl->Dirty.clear();
		++Impl->PublishCount;
	}
	// After the lock: a callback may read or set variables; what it sets is published by the next frame.
	for (const auto& [Callback, Variable] : Callbacks) Callback(*Variable);
}

uint64_t FConsoleVariables::GetPublishCount() const
{
	std::shared_lock Lock(Impl->Mutex);
	return Impl->PublishCount;
}

bool FConsoleVariables::HasUnpublished() const
{
	std::shared_lock Lock(Impl->Mutex);
	const auto IsNew = [](const FRTConsoleVariable* Variable) { return Variable->State->Published != Variable->State->Latest; };
	return std::any_of(Impl->Dirty.begin(), Impl->Dirty.end(), IsNew);
}

void FConsoleVariables::Restore(const FRTConsoleVariable& Variable, FRTCVarValue Value, ERTSetBy By)
{
	std::unique_lock Lock(Impl->Mutex);
	FRTConsoleVariable* const Mine = Impl->Find(Variable.GetName()).Variable;
	assert(Mine == &Variable && Value.index() == Mine->State->Default.index());
	Mine->State->Latest = std::move(Value);
	Mine->State->SetBy = By;
	Impl->MarkDirty(*Mine);
}

void FConsoleVariables::ResetAll()
{
	std::unique_lock Lock(Impl->Mutex);
	for (const auto& [Folded, Variable] : Impl->Variables)
	{
		FRTConsoleVariable::FState& State = *Variable->State;
		State.Latest = State.Default;
		State.SetBy = ERTSetBy::Code;
		State.ClampWarned = 0;
		Impl->MarkDirty(*Variable);
	}
}

std::string FConsoleVariables::ToString(const FRTCVarValue& Value)
{
	if (const auto* Bool = std::get_if<bool>(&Value)) return *Bool ? "1" : "0";
	if (const auto* Int = std::get_if<int32_t>(&Value)) return fmt::format("{}", *Int);
	if (const auto* Float = std::get_if<float>(&Value))
		return fmt::format("{}", *Float); // the shortest text that reads back as the same value
	return std::get<std::string>(Value);
}

} // namespace Lantern
