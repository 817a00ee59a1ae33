// Console variables: typed, named r.RT.<Pass>.<Knob>, defined beside the code that reads them.
//
//   static TRTConsoleVariable<int32_t> CVarShadowSamples("r.RT.Shadow.Samples", 1,
//       "Sun shadow rays per pixel.", {1, 64});
//   ... CVarShadowSamples.GetOnRenderThread()
//
// Set from any thread. The value that the render thread reads changes only in
// FConsoleVariables::BeginFrame(), so that a toggle flipped in the middle of a frame never breaks it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace Lantern
{

/// Who set a value last. A lower one never overrides a higher one (UE's order, shortened).
enum class ERTSetBy : uint8_t
{
	Code,          ///< the default
	Ini,           ///< Default*.ini and --config
	Scalability,   ///< Scalability.ini by --quality
	DeviceProfile, ///< DeviceProfiles.ini by device
	CommandLine,   ///< --set
	Console,       ///< set by the host at run time; always wins
};
const char* ToString(ERTSetBy By);

using FRTCVarValue = std::variant<bool, int32_t, float, std::string>;

/// Inclusive. Values outside are clamped, with one warning. Ignored for bool and string.
struct FRTCVarRange
{
	double Min = -1e30, Max = 1e30;
};

/// Untyped part. Lives as long as the program (static storage); registers itself on construction.
class FRTConsoleVariable
{
public:
	FRTConsoleVariable(const char* Name, FRTCVarValue Default, const char* Help, FRTCVarRange Range);
	~FRTConsoleVariable();
	FRTConsoleVariable(const FRTConsoleVariable&) = delete;
	FRTConsoleVariable& operator=(const FRTConsoleVariable&) = delete;

	const std::string& GetName() const;
	const std::string& GetHelp() const;
	const FRTCVarValue& GetDefault() const;
	FRTCVarRange GetRange() const;
	ERTSetBy GetSetBy() const;
	FRTCVarValue GetValue() const; ///< the newest value, any thread
	/// Called by BeginFrame, on its thread, after the value changed.
	void SetCallback(std::function<void(const FRTConsoleVariable&)> Callback);

protected:
	friend class FConsoleVariables;
	struct FState;
	std::unique_ptr<FState> State;
};

template <class T> // bool, int32_t, float or std::string
class TRTConsoleVariable : public FRTConsoleVariable
{
public:
	TRTConsoleVariable(const char* Name, T Default, const char* Help, FRTCVarRange Range = {})
	    : FRTConsoleVariable(Name, FRTCVarValue(std::move(Default)), Help, Range)
	{}
	T Get() const { return std::get<T>(GetValue()); }
	/// As of the last BeginFrame; only on the thread that calls BeginFrame or tasks that it waits for.
	const T& GetOnRenderThread() const;
};

/// The registry.
class FConsoleVariables
{
public:
	static FConsoleVariables& Get();

	/// Sets by name or alias (case-insensitive, as UE). Accepts 0/1/true/false for bool. A wrong name, type
	/// or value gives one clear message naming the nearest known name, logged as a warning, and is returned;
	/// nothing changes then. Where says the place for the message ("--set", "Config/X.ini:12").
	/// A value refused because a higher ERTSetBy set it before is no error.
	std::optional<std::string> Set(std::string_view Name, std::string_view Value, ERTSetBy By, std::string_view Where);
	const FRTConsoleVariable* Find(std::string_view NameOrAlias) const;
	std::vector<const FRTConsoleVariable*> GetAll() const; ///< sorted by name
	/// Old or engine name → ours. One line in ConsoleVariableAliases.ini each.
	void AddAlias(std::string_view Alias, std::string_view Name);
	std::vector<std::pair<std::string, std::string>> GetAliases() const;

	/// Publishes values to the render thread and runs callbacks of those that changed.
	void BeginFrame();
	/// Puts a variable back to what its GetValue() and GetSetBy() were, whoever set it since. Value: of its type.
	void Restore(const FRTConsoleVariable& Variable, FRTCVarValue Value, ERTSetBy By);
	/// Back to defaults, ERTSetBy::Code (tests).
	void ResetAll();

	std::string ToMarkdown() const; ///< Docs/ConsoleVariables.md
	std::string ToJson() const;
	static std::string ToString(const FRTCVarValue& Value);

private:
	FConsoleVariables();
	~FConsoleVariables();
	friend class FRTConsoleVariable;
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
