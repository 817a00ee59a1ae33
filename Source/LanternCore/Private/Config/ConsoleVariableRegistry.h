// Internals of FConsoleVariables. One lock guards everything that any thread may touch. FState::Published belongs to the render
// thread alone, which reads it without the lock.
#pragma once

#include <map>
#include <shared_mutex>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

struct FRTConsoleVariable::FState
{
	const std::string Name, Help;
	const FRTCVarValue Default;
	const FRTCVarRange Range;

	// Guarded by FImpl::Mutex.
	FRTCVarValue Latest;
	ERTSetBy SetBy = ERTSetBy::Code;
	std::function<void(const FRTConsoleVariable&)> Callback;
	/// The bound last warned about (-1, 0, +1), so that a value set every frame is not reported every frame.
	int ClampWarned = 0;
	bool bDirty = false;

	// Written in BeginFrame only.
	FRTCVarValue Published;
};

struct FConsoleVariables::FImpl
{
	mutable std::shared_mutex Mutex;
	/// Keys are folded names.
	std::map<std::string, FRTConsoleVariable*> Variables;
	struct FAlias
	{
		std::string Alias, Name;
		double Factor = 1.0; ///< of numbers that are set by it
	};
	std::map<std::string, FAlias> Aliases;
	/// Variables that were set since the last BeginFrame.
	std::vector<FRTConsoleVariable*> Dirty;
	uint64_t PublishCount = 0; ///< guarded by Mutex

	void Register(FRTConsoleVariable& Variable);
	void Unregister(FRTConsoleVariable& Variable);

	struct FOutcome
	{
		bool bRefused = false;
		std::string Warning; ///< of a refusal or of a clamp; empty: none
	};
	FOutcome Set(std::string_view Name, std::string_view Value, ERTSetBy By);

	struct FFound
	{
		FRTConsoleVariable* Variable = nullptr;
		double Factor = 1.0; ///< from the alias to the variable
	};
	// The caller holds Mutex.
	FFound Find(std::string_view NameOrAlias) const;
	std::string DescribeUnknown(std::string_view Name) const;
	void MarkDirty(FRTConsoleVariable& Variable);
};

} // namespace Lantern
