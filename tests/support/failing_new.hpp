// An operator new that fails when it is told to. A test program that links failing_new.cpp uses it for everything.
#pragma once

namespace lamina::test {

/// While it lives, the n-th call of operator new, on whichever thread, fails; n counts from 1.
class FailingNew {
public:
    explicit FailingNew(long n);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    /// Lets no further call fail. Returns whether that call has come.
    bool disarm();

private:
    bool has_failed_ = false;
};

}  // namespace lamina::test
